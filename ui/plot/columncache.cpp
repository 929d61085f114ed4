// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/columncache.h"

#include <algorithm>

namespace dynascope {

std::span<const History::Column> ColumnCache::columns(const History &history, const TimeView &view)
{
    if (history.isEmpty()) {
        m_columns.assign(static_cast<std::size_t>(view.columns), {});
        m_history = nullptr;
        return m_columns;
    }
    std::int64_t firstStale = view.firstColumn;
    const bool isKept = m_history == &history && m_view.step == view.step && m_view.columns == view.columns
        && view.firstColumn >= m_view.firstColumn && view.firstColumn < m_view.firstColumn + m_view.columns
        && m_mark.stillHolds(history);
    if (isKept) {
        const auto moved = static_cast<std::ptrdiff_t>(view.firstColumn - m_view.firstColumn);
        std::move(m_columns.begin() + moved, m_columns.end(), m_columns.begin());
        // More may have come into the column of what was the newest sample, never before it.
        firstStale =
            std::clamp<std::int64_t>(m_mark.last.at / view.step, view.firstColumn, m_view.firstColumn + m_view.columns);
    } else {
        m_columns.resize(static_cast<std::size_t>(view.columns));
    }
    const auto stale = std::span(m_columns).subspan(static_cast<std::size_t>(firstStale - view.firstColumn));
    history.columns(view.step * firstStale, view.to(), stale);
    m_history = &history;
    m_mark = HistoryMark::of(history);
    m_view = view;
    return m_columns;
}

} // namespace dynascope
