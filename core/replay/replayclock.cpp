// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/replayclock.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

ReplayClock::ReplayClock(LineTime begin, LineTime end) : m_begin(begin), m_end(std::max(begin, end)), m_position(begin) { }

void ReplayClock::extend(LineTime end)
{
    m_end = std::max(m_end, end);
}

void ReplayClock::seek(LineTime to)
{
    m_position = std::clamp(to, m_begin, m_end);
    m_rest = 0;
}

void ReplayClock::play()
{
    if (m_position >= m_end)
        seek(m_begin);
    m_isPlaying = m_begin < m_end;
}

void ReplayClock::setSpeed(double speed)
{
    if (!std::isnan(speed))
        m_speed = std::clamp(speed, SlowestSpeed, FastestSpeed);
}

bool ReplayClock::advance(LineTime passed)
{
    if (!m_isPlaying || passed <= LineTime(0))
        return false;
    const double wanted = static_cast<double>(passed.count()) * m_speed + m_rest;
    const double left = static_cast<double>((m_end - m_position).count());
    if (wanted >= left) {
        m_position = m_end;
        m_rest = 0;
        m_isPlaying = false;
        return true;
    }
    const double whole = std::floor(wanted);
    m_rest = wanted - whole;
    m_position += LineTime(static_cast<std::int64_t>(whole));
    return whole > 0;
}

} // namespace dynascope
