// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/timewindow.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

void TimeWindow::setSpan(LineTime span)
{
    m_span = std::clamp(span, ShortestSpan, LongestSpan);
    m_pausedSpan = m_span;
}

void TimeWindow::pause(LineTime newest, LineTime last)
{
    if (!m_live)
        return;
    m_live = false;
    m_zero = m_origin.value_or(newest);
    m_last = std::max(newest, last);
    m_end = newest;
    m_pausedSpan = m_span;
}

void TimeWindow::pan(LineTime by)
{
    if (!m_live)
        m_end = std::min(m_end + by, m_last);
}

void TimeWindow::zoom(double factor, LineTime around)
{
    if (m_live)
        return;
    const auto wanted = LineTime(static_cast<std::int64_t>(static_cast<double>(m_pausedSpan.count()) * factor));
    const LineTime span = std::clamp(wanted, ShortestZoom, LongestZoom);
    const double actual = static_cast<double>(span.count()) / static_cast<double>(m_pausedSpan.count());
    m_end = std::min(around + LineTime(std::llround(static_cast<double>((m_end - around).count()) * actual)), m_last);
    m_pausedSpan = span;
}

void TimeWindow::show(LineTime from, LineTime to)
{
    if (m_live || to <= from)
        return;
    m_pausedSpan = std::clamp(to - from, ShortestZoom, LongestZoom);
    m_end = std::min(from + (to - from) / 2 + m_pausedSpan / 2, m_last);
}

void TimeWindow::hold(LineTime zero, LineTime before, LineTime after, LineTime last)
{
    m_live = false;
    m_zero = zero;
    m_end = zero + after;
    m_last = std::max(last, m_end);
    m_pausedSpan = std::clamp(before + after, ShortestZoom, LongestZoom);
}

TimeView TimeWindow::view(int columns, LineTime newest) const
{
    const int count = std::max(columns, 1);
    const LineTime span = m_live ? m_span : m_pausedSpan;
    const LineTime end = m_live ? newest : m_end;
    TimeView view;
    view.step = std::max(LineTime(1), (span + LineTime(count - 1)) / count); // up: the whole span is in sight
    view.columns = count;
    view.firstColumn = end / view.step - count + 1; // the column that holds `end` is the last
    view.zero = m_live ? view.to() : m_zero;
    if (!m_live)
        view.until = m_last;
    return view;
}

} // namespace dynascope
