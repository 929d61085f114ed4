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
    /// To those listed at this rate and nobody else: an ID of another rate may here be a model that keeps something else
    /// at that address. Who is in the middle of a change of rate has its torque off, or its EEPROM would be locked.
    const std::vector<Bytes> &packets(int baudRate) const;

private:
    std::vector<Bytes> make(int baudRate) const;

    std::vector<StopTarget> m_targets;
    std::map<int, std::vector<Bytes>> m_packets;
};

/// Sends the packets at the line's present baud rate as soon as the wire is free, again after 2 ms of quiet, then at
/// the other bauds, and goes back to `workingBaud`. Heeds no stop flag. Fails with PortLost only.
Result<void> sendTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud);

/// Asks each device at its baud rate which model it is, reads its Torque Enable back, and writes once more where that
/// still says 1. Who is then not confirmed at `workingBaud` is asked a second time, a moment later. Another model there is
/// not written to, and confirms nothing. Ends early, with nothing, where STOP is pressed again or the line is closed. The
/// line is left at `workingBaud`.
std::vector<StopOutcome> verifyTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud);

} // namespace dynascope
