// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/window/lines.h"
#include "app/window/options.h"
#include "app/window/replayroom.h"
#include "core/session/indirectreads.h"
#include "core/session/journal/undo.h"
#include "core/session/ramguard.h"
#include "core/session/scanner.h"
#include "core/session/settingscommands.h"
#include "core/session/stopcontrol.h"
#include "core/session/monitor.h"
#include "core/table/usertables.h"
#include "ui/mainwindow.h"

class QApplication;

namespace dynascope {

/// Everything the window works with, made in the order it needs and unmade in reverse. GUI thread; one a process, owned by
/// main or by a test.
class Workshop
{
public:
    Workshop(QApplication &application, const WindowOptions &options);
    ~Workshop();

    Session &session() { return m_session; }
    Commands &commands() { return m_commands; }
    Monitor &monitor() { return m_monitor; }
    Scanner &scanner() { return m_scanner; }
    StopControl &stop() { return m_stop; }
    Lines &lines() { return m_lines; }
    MainWindow &window() { return *m_window; }

    void applyScheme(ColorScheme scheme); ///< and remembers it
    /// In a window of its own; what can't be read is said in the main window. nullptr then.
    ReplayRoom *openRecording(const QString &path);

private:
    QApplication &m_application;
    Catalog m_catalog;
    UserTables m_tables; ///< what came of a person's own
    Lines m_lines;
    Session m_session;
    Journal m_journal;
    Commands m_commands;
    Undo m_undo;
    SettingsCommands m_settings;
    Monitor m_monitor;
    RamGuard m_ramGuard;
    IndirectReads m_indirect;
    Scanner m_scanner;
    StopControl m_stop;
    std::unique_ptr<MainWindow> m_window;
    std::size_t m_historyBudget = 0; ///< bytes; 0: the usual one
    std::vector<std::unique_ptr<ReplayRoom>> m_rooms;
};

} // namespace dynascope
