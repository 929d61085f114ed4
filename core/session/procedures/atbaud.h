// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

namespace dynascope {

/// While it lives the line works at another baud rate; afterwards at the one it had.
/// Bus thread, inside one job.
class AtBaud
{
public:
    AtBaud(Bus &bus, int bitsPerSecond)
        : m_bus(bus)
        , m_home(bus.line().baudRate())
    {
        if (bitsPerSecond != m_home)
            m_entered = bus.setBaudRate(bitsPerSecond);
    }
    ~AtBaud()
    {
        if (m_bus.line().baudRate() != m_home)
            m_bus.setBaudRate(m_home); // a port that is lost says so at the next exchange
    }
    AtBaud(const AtBaud &) = delete;
    AtBaud &operator=(const AtBaud &) = delete;

    Result<void> entered() const { return m_entered; } ///< PortUnsuitable: the port can't do this rate

private:
    Bus &m_bus;
    int m_home;
    Result<void> m_entered;
};

} // namespace dynascope
