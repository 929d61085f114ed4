// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history.h"

namespace dynascope {

/// How far a history had come when last looked at. Tells whether it has only grown since, or is another one now:
/// emptied and perhaps filled again.
struct HistoryMark {
    std::uint64_t appended = 0;
    History::Sample last;

    static HistoryMark of(const History &history)
    {
        return history.isEmpty() ? HistoryMark{} : HistoryMark{history.appended(), history.last()};
    }
    bool stillHolds(const History &history) const
    {
        if (appended == 0 || history.appended() < appended)
            return appended == 0 && history.isEmpty();
        const std::uint64_t since = history.appended() - appended;
        return since < history.size() && history.at(history.size() - 1 - static_cast<std::size_t>(since)) == last;
    }
};

} // namespace dynascope
