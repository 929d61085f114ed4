// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controlverbs.h"

#include <QJsonArray>

namespace dynascope::sim::verbs {

bool push(Servo &, double, double)
{
    return false;
}

bool hold(Servo &, std::optional<double>)
{
    return false;
}

bool setStops(Servo &, std::optional<double>, std::optional<double>)
{
    return false;
}

bool setPower(Servo &servo, bool on)
{
    servo.setPlugged(on);
    return true;
}

bool setPower(SimulatedBus &bus, bool on)
{
    for (const auto &servo : bus.servos())
        servo->setPlugged(on);
    return true;
}

bool setSupply(SimulatedBus &bus, double volts)
{
    for (const auto &servo : bus.servos())
        servo->joint().setSupplyVoltage(volts);
    return true;
}

bool setSupply(Servo &servo, double volts)
{
    servo.joint().setSupplyVoltage(volts);
    return true;
}

double shaftAngle(Servo &servo)
{
    return servo.joint().state().position * 360.0 / servo.table().resolution();
}

QJsonObject truth(Servo &servo)
{
    QJsonObject registers;
    for (const Field &field : servo.table().fields())
        registers.insert(field.name, static_cast<qint64>(servo.value(field.name)));
    const JointState state = servo.joint().state();
    const QJsonObject physical{{QStringLiteral("angle"), shaftAngle(servo)},
                               {QStringLiteral("voltage"), state.inputVoltage / 10.0},
                               {QStringLiteral("caseTemperature"), state.temperature}};
    return {{QStringLiteral("model"), servo.model()},
            {QStringLiteral("firmware"), servo.firmware()},
            {QStringLiteral("id"), servo.id()},
            {QStringLiteral("baudRate"), servo.baudRate()},
            {QStringLiteral("registers"), registers},
            {QStringLiteral("physical"), physical}};
}

QJsonObject truth(SimulatedBus &bus)
{
    QJsonArray servos;
    for (const auto &servo : bus.servos())
        servos.append(truth(*servo));
    const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(bus.now());
    return {{QStringLiteral("time"), static_cast<qint64>(time.count())}, {QStringLiteral("servos"), servos}};
}

} // namespace dynascope::sim::verbs
