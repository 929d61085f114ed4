// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/tracedata.h"

#include <vector>

namespace dynascope {

/// The columns of one history in one view, kept from frame to frame: a live frame computes the few that are new.
class ColumnCache
{
public:
    std::span<const History::Column> columns(const History &history, const TimeView &view);
    void clear() { m_history = nullptr; }

private:
    bool isStillTrue(const History &history, const TimeView &view) const;

    const History *m_history = nullptr;
    std::uint64_t m_appended = 0; ///< of m_history when last looked at
    History::Sample m_last;       ///< its newest sample then
    TimeView m_view;
    std::vector<History::Column> m_columns;
};

} // namespace dynascope
