// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/columncache.h"

#include <algorithm>
#include <cstdlib>

namespace dynascope {

std::span<const History::Column> ColumnCache::columns(const History &history, const TimeView &view)
{
    if (history.isEmpty()) {
        m_columns.assign(static_cast<std::size_t>(view.columns), {});
        m_history = nullptr;
        return m_columns;
    }
    const std::int64_t moved = view.firstColumn - m_view.firstColumn;
    const bool isKept = m_history == &history && m_view.step == view.step && m_view.columns == view.columns
        && std::abs(moved) < view.columns && m_mark.stillHolds(history);
    m_columns.resize(static_cast<std::size_t>(view.columns));
    std::int64_t firstStale = view.firstColumn;
    if (isKept) {
        if (moved > 0)
            std::move(m_columns.begin() + moved, m_columns.end(), m_columns.begin());
        else if (moved < 0) // somebody scrolls back
            std::move_backward(m_columns.begin(), m_columns.end() + moved, m_columns.end());
        fill(history, view, view.firstColumn, m_view.firstColumn);
        // More may have come into the column of what was the newest sample, never before it.
        firstStale = std::clamp<std::int64_t>(m_mark.last.at / view.step, view.firstColumn,
            std::min(view.firstColumn, m_view.firstColumn) + view.columns);
    }
    fill(history, view, firstStale, view.firstColumn + view.columns);
    m_history = &history;
    m_mark = HistoryMark::of(history);
    m_view = view;
    return m_columns;
}

/// Columns [from, to) of the view.
void ColumnCache::fill(const History &history, const TimeView &view, std::int64_t from, std::int64_t to)
{
    if (from >= to)
        return;
    const auto first = static_cast<std::size_t>(from - view.firstColumn);
    history.columns(view.step * from, view.step * to, std::span(m_columns).subspan(first, static_cast<std::size_t>(to - from)));
}

} // namespace dynascope
