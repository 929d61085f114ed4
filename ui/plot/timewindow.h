// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/tracedata.h"

#include <optional>

namespace dynascope {

/// Which stretch of time the plots show: the last `span` up to the newest sample, or, paused, one that can be moved and
/// zoomed.
class TimeWindow
{
public:
    static constexpr LineTime ShortestSpan = std::chrono::seconds(1);
    static constexpr LineTime LongestSpan = std::chrono::seconds(600);
    static constexpr LineTime ShortestZoom = std::chrono::milliseconds(5); ///< while paused
    static constexpr LineTime LongestZoom = std::chrono::hours(24 * 7);

    LineTime span() const { return m_span; } ///< of the live view; a paused one may be zoomed further
    void setSpan(LineTime span);             ///< within the limits

    bool isLive() const { return m_live; }
    void setLive() { m_live = true; }
    void setOrigin(LineTime origin) { m_origin = origin; } ///< what the axis calls 0 s when paused
    /// What is seen, up to `newest`, stays. `last`: up to where it may be moved; in a replay there is more.
    void pause(LineTime newest, LineTime last);
    void pause(LineTime newest) { pause(newest, newest); }
    LineTime pausedAt() const { return m_last; } ///< while paused: the last there was then
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
    std::optional<LineTime> m_origin;
    LineTime m_zero{}; ///< paused: what the axis calls 0 s
    LineTime m_last{}; ///< paused: the last there was then
    LineTime m_end{};  ///< paused: the view's right edge
    LineTime m_pausedSpan{};
};

} // namespace dynascope
