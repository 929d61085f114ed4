// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/historymark.h"
#include "ui/plot/tracedata.h"

#include <vector>

namespace dynascope {

/// The columns of one history in one view, kept from frame to frame: a live frame computes the few that are new.
class ColumnCache
{
public:
    std::span<const History::Column> columns(const History &history, const TimeView &view);

private:
    const History *m_history = nullptr;
    HistoryMark m_mark;
    TimeView m_view;
    std::vector<History::Column> m_columns;
};

} // namespace dynascope
