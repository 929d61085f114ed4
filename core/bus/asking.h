// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

namespace dynascope {

/// While one lives, nothing received is an answer, not a fault of the line, and counts nowhere, as with a Ping: whoever is
/// asked was silent before, or may not be there. Bus thread.
class Asking
{
public:
    explicit Asking(Bus &bus, bool isAsking = true) : m_bus(bus), m_isAsking(isAsking) { m_bus.m_asking += m_isAsking; }
    ~Asking() { m_bus.m_asking -= m_isAsking; }
    Asking(const Asking &) = delete;
    Asking &operator=(const Asking &) = delete;

private:
    Bus &m_bus;
    const bool m_isAsking;
};

} // namespace dynascope
