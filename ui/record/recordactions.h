// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/messagebar.h"
#include "ui/record/sessionrecorder.h"
#include "ui/record/sessionstream.h"

class QAction;

namespace dynascope {

class EventLog;

/// Record and stream: what a person can ask for, and what is said of it. GUI thread.
class RecordActions : public QObject
{
    Q_OBJECT

public:
    /// `log` outlives it, and so does all that `workbench` names.
    RecordActions(const Workbench &workbench, const EventLog &log, QWidget *window);

    std::vector<QAction *> actions() const { return m_actions; } ///< for a menu
    QWidget *badge() const { return m_badge; } ///< for the status bar
    const SessionRecorder &recorder() const { return m_recorder; }
    void finish() { m_recorder.finish(); }     ///< the window closes: waits until all is in the file

signals:
    void posted(const dynascope::Message &message);
    void openRequested(const QString &path); ///< what was just recorded

private:
    QAction *add(const QString &name, const QString &text, const QString &tip, const QString &iconName);
    void toggle();
    void showState();
    void sayEnd();
    void openOptions();
    void openStream();

    QWidget *m_window;
    SessionRecorder m_recorder;
    SessionStream m_stream;
    std::vector<QAction *> m_actions;
    QAction *m_record;
    QWidget *m_badge;
};

} // namespace dynascope
