// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"

/// What a control channel and a bus file do to servos and their surroundings beyond what these offer themselves.
namespace dynascope::sim::verbs {

void setPower(SimulatedBus &bus, bool on);     ///< the main switch, of devices with a supply of their own too
void setSupply(Servo &servo, double volts);    ///< from now on it has a supply of its own
double shaftAngle(Servo &servo);               ///< degrees, many turns

} // namespace dynascope::sim::verbs
