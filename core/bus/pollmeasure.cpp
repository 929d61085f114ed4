// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/pollmeasure.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime Window = 1s;
constexpr LineTime FirstWindow = 100ms;
constexpr int Enough = 16;             ///< exchanges
constexpr LineTime LongestPause = 5ms; ///< between cycles: beyond it something else was done on the line

} // namespace

void PollMeasure::reset(const LineDelays &known)
{
    *this = {};
    m_delays = known;
}

void PollMeasure::addExchange(LineTime took, LineTime modelled)
{
    m_exchanges += took - modelled;
    ++m_exchangeCount;
}

void PollMeasure::addCycle(LineTime between)
{
    if (between > LongestPause)
        return;
    m_cycles += between;
    ++m_cycleCount;
}

bool PollMeasure::update(LineTime now)
{
    if (!m_began) {
        m_began = true;
        m_since = now;
    }
    if (m_exchangeCount < Enough || now - m_since < (m_known ? Window : FirstWindow))
        return false;
    const LineTime exchange = m_exchanges / m_exchangeCount;
    const LineTime cycle = m_cycleCount > 0 ? m_cycles / m_cycleCount : LineTime();
    m_delays.perExchange = m_known ? (m_delays.perExchange + exchange) / 2 : exchange;
    m_delays.perCycle = m_known ? (m_delays.perCycle + cycle) / 2 : cycle;
    m_known = true;
    m_exchanges = m_cycles = {};
    m_exchangeCount = m_cycleCount = 0;
    m_since = now;
    return true;
}

} // namespace dynascope
