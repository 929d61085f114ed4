// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/replay/recordedlines.h"
#include "core/replay/replayer.h"
#include "core/session/monitor.h"
#include "ui/replay/replaywindow.h"

namespace dynascope {

/// A recording that is open, with its window: a session of its own, beside the live one. GUI thread, owned by Workshop.
class ReplayRoom
{
public:
    /// BadFile. `historyBudget` in bytes; 0: the usual one.
    static Result<std::unique_ptr<ReplayRoom>> open(const Catalog &catalog, const QString &path,
                                                    std::size_t historyBudget = 0);

    Replayer &replayer() { return m_replayer; }
    Session &session() { return m_session; }
    Monitor &monitor() { return m_monitor; }
    ReplayWindow &window() { return *m_window; }

private:
    explicit ReplayRoom(const Catalog &catalog);

    RecordedLines m_lines;
    Session m_session;
    Monitor m_monitor;
    Replayer m_replayer;
    std::unique_ptr<ReplayWindow> m_window;
};

} // namespace dynascope
