// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"

#include <QJsonObject>

/// What a control channel does to servos and their surroundings, in one place. False: this simulator can't.
namespace dynascope::sim::verbs {

bool push(Servo &servo, double newtonMetres, double seconds);
bool hold(Servo &servo, std::optional<double> degrees); ///< a hand that keeps the shaft there; nothing: lets go
bool setStops(Servo &servo, std::optional<double> lowest, std::optional<double> highest); ///< degrees
bool setPower(Servo &servo, bool on);
bool setPower(SimulatedBus &bus, bool on);
bool setSupply(SimulatedBus &bus, double volts);
bool setSupply(Servo &servo, double volts);
double shaftAngle(Servo &servo); ///< degrees
QJsonObject truth(Servo &servo);
QJsonObject truth(SimulatedBus &bus);

} // namespace dynascope::sim::verbs
