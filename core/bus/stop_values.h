// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/requests.h"

#include <QString>

namespace dynascope {

/// How to turn one device's torque off, ready before it is needed.
struct StopTarget {
    quint32 device = 0; ///< the session's number
    std::uint8_t id = 0;
    int baudRate = 57600;
    std::uint16_t torqueAddress = 64; ///< of its own model's Torque Enable
    std::uint16_t modelNumber = 0;    ///< who must answer there to be believed; 0: whoever does

    friend bool operator==(const StopTarget &, const StopTarget &) = default;
};

/// What STOP can say of one device.
struct StopOutcome {
    quint32 device = 0;
    bool off = false; ///< read back as 0
    QString text;     ///< where not: what was seen
};

} // namespace dynascope
