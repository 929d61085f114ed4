// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/tracedata.h"

namespace dynascope {

/// Which stretch of time the plots show: the last `span` up to the newest sample, or, paused, one that can be moved and
/// zoomed.
class TimeWindow
{
public:
    static constexpr LineTime ShortestSpan = std::chrono::seconds(1);
    static constexpr LineTime LongestSpan = std::chrono::seconds(600);
    static constexpr LineTime ShortestZoom = std::chrono::milliseconds(5); ///< while paused

    LineTime span() const { return m_span; } ///< of the live view; a paused one may be zoomed further
    void setSpan(LineTime span);             ///< within the limits

    bool isLive() const { return m_live; }
    void setLive() { m_live = true; }
    void pause(LineTime newest); ///< what is seen stays
    LineTime pausedAt() const { return m_last; } ///< while paused: the newest sample then
    /// Stands around `zero`, also where it was live; nothing after `last` is shown.
    void hold(LineTime zero, LineTime before, LineTime after, LineTime last);

    /// While paused.
    void pan(LineTime by);
    void zoom(double factor, LineTime around);
    void show(LineTime from, LineTime to); ///< within the limits of zooming

    TimeView view(int columns, LineTime newest) const;

private:
    LineTime m_span = std::chrono::seconds(10);
    bool m_live = true;
    LineTime m_zero{}; ///< paused: what the axis calls 0 s
    LineTime m_last{}; ///< paused: the newest sample then
    LineTime m_end{};  ///< paused: the view's right edge
    LineTime m_pausedSpan{};
};

} // namespace dynascope
