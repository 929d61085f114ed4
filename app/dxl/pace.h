// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <algorithm>
#include <optional>

namespace dynascope::dxl {

inline double seconds(LineTime duration)
{
    return std::chrono::duration<double>(duration).count();
}

inline LineTime fromSeconds(double value)
{
    return std::chrono::duration_cast<LineTime>(std::chrono::duration<double>(value));
}

/// When each sample is due: on a grid from the begin on, so that the rate holds; a slot that passed is left out.
class Pace
{
public:
    /// `rate`: samples a second; 0: as many as there is time for. `length`: seconds; nothing: without end.
    Pace(double rate, std::optional<double> length, LineTime begin)
        : m_period(rate > 0 ? fromSeconds(1 / rate) : LineTime())
        , m_next(begin)
        , m_end(length ? begin + fromSeconds(*length) : LineTime::max())
    {
    }

    bool isOver(LineTime now) const { return now >= m_end; }
    LineTime until(LineTime now) const { return std::min(m_next, m_end) - now; }
    void taken(LineTime now)
    {
        if (m_period <= LineTime())
            return;
        const auto passed = std::max<LineTime::rep>(0, (now - m_next) / m_period);
        m_next += (passed + 1) * m_period;
    }

private:
    LineTime m_period, m_next, m_end;
};

} // namespace dynascope::dxl
