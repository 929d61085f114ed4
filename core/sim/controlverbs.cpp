// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controlverbs.h"

#include "core/sim/power.h"

#include <numbers>

namespace dynascope::sim::verbs {

void setPower(SimulatedBus &bus, bool on)
{
    bus.power().setOn(on);
    for (const auto &servo : bus.servos()) {
        servo->joint().supply().setOn(on);
        servo->followSupply();
    }
}

void setSupply(Servo &servo, double volts)
{
    const bool on = servo.joint().supply().isOn();
    servo.joint().share(nullptr);
    servo.joint().supply().setOn(on);
    servo.joint().setSupplyVoltage(volts);
    servo.followSupply();
}

double shaftAngle(Servo &servo)
{
    return servo.joint().plant().angle() * 180 / std::numbers::pi;
}

} // namespace dynascope::sim::verbs
