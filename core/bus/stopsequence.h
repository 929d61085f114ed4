// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"
#include "core/bus/stop_values.h"

#include <map>

namespace dynascope {

/// The torque-off packets of all known devices, made before they are needed: for each baud rate Sync Writes to each
/// model's own Torque Enable. Never a broadcast Write: 64 is EEPROM in some families.
class StopPlan
{
public:
    StopPlan() = default;
    explicit StopPlan(std::vector<StopTarget> targets);

    const std::vector<StopTarget> &targets() const { return m_targets; }
    std::vector<int> bauds() const;
    /// Those listed at this rate, and the others whose ID isn't listed here: a device may be in the middle of a change.
    const std::vector<Bytes> &packets(int baudRate) const;

private:
    std::vector<Bytes> make(int baudRate) const;

    std::vector<StopTarget> m_targets;
    std::map<int, std::vector<Bytes>> m_packets;
    std::vector<Bytes> m_elsewhere; ///< at a rate where nobody is listed
};

/// Sends the packets at the line's present baud rate as soon as the wire is free, again after 2 ms of quiet, then at
/// the other bauds, and goes back to `workingBaud`. Heeds no stop flag. Fails with PortLost only.
Result<void> sendTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud);

/// Reads each device's Torque Enable back, at its baud rate or else at `alsoTry`; sends its packet once more where it
/// still says 1. Ends early, with nothing, where STOP is pressed again or the
/// line is closed. The line is left at `workingBaud`.
std::vector<StopOutcome> verifyTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud, int alsoTry);

} // namespace dynascope
