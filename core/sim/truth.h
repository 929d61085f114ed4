// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QJsonObject>

namespace dynascope::sim {

class Servo;
class SimulatedBus;

/// A servo as it really is, as of the last advanceTo(), for people and tests:
///   "model", "firmware", "id", "baudRate" (bit/s); "registers" by name, raw
///   "physical": angle (degrees of the shaft, many turns), speed (rev/min), motorTorque, loadTorque, handTorque (N·m),
///     motorCurrent, supplyCurrent (A), voltage (V, as it arrives), windingTemperature, caseTemperature, ambient (°C)
///   "led": "off", "on" or "blinking"; "power", "deaf" (true or false); "torque"; "shutDown"; "hardwareErrors": names
///   "motor": "name", and the names of its "known" and "chosen" figures
QJsonObject truth(Servo &servo);

/// "time" (ms on the bus's clock), "power" with "on" and "supplies" (voltage, resistance, terminalVoltage, current),
/// and "servos", as above.
QJsonObject truth(const SimulatedBus &bus);

} // namespace dynascope::sim
