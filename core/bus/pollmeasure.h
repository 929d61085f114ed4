// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/readcost.h"

namespace dynascope {

/// What adapter and host add while a line is polled: means over about a second, the first one sooner.
class PollMeasure
{
public:
    /// Of an exchange whose every answer came: so long it took, and would have by the wire.
    void addExchange(LineTime took, LineTime modelled);
    /// Of one cycle: what of it was no exchange, with the time since the one before where that was due at once.
    void addCycle(LineTime between);
    void addProbe(LineTime took) { m_delays.probe = took; }
    /// Looks whether a mean is due. True: delays() are others now.
    bool update(LineTime now);
    void reset(const LineDelays &known); ///< another rate: all is to be measured anew

    const LineDelays &delays() const { return m_delays; }

private:
    LineDelays m_delays;
    LineTime m_exchanges{}, m_cycles{};
    int m_exchangeCount = 0, m_cycleCount = 0;
    LineTime m_since{};
    bool m_began = false, m_known = false;
};

} // namespace dynascope
