// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/historymark.h"
#include "ui/plot/tracedata.h"

#include <vector>

namespace dynascope {

/// The columns of one history in one view, kept from frame to frame: where a view moves on or is
/// scrolled only the few that are new are computed.
class ColumnCache
{
public:
    std::span<const History::Column> columns(const History &history, const TimeView &view);

private:
    void fill(const History &history, const TimeView &view, std::int64_t from, std::int64_t to);

    const History *m_history = nullptr;
    HistoryMark m_mark;
    TimeView m_view;
    std::vector<History::Column> m_columns;
};

} // namespace dynascope
