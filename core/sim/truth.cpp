// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"

#include "core/sim/power.h"
#include "core/sim/registerfile.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"

#include <QJsonArray>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dynascope::sim {
namespace {

/// People read it: no more digits than mean something.
double rounded(double value)
{
    return std::round(value * 1e4) / 1e4;
}

double degrees(double radians)
{
    return rounded(radians * 180 / std::numbers::pi);
}

QJsonObject physical(const Joint &joint)
{
    const Plant &plant = joint.plant();
    const Load &load = plant.load();
    QJsonObject state{
        {QStringLiteral("angle"), degrees(plant.angle())},
        {QStringLiteral("speed"), rounded(plant.speed() * 30 / std::numbers::pi)},
        {QStringLiteral("motorTorque"), rounded(plant.motorTorque())},
        {QStringLiteral("loadTorque"), rounded(load.at(plant.angle(), plant.speed(), plant.inertia()).torque)},
        {QStringLiteral("handTorque"), rounded(load.handTorque())},
        {QStringLiteral("motorCurrent"), rounded(plant.current())},
        {QStringLiteral("supplyCurrent"), rounded(joint.supplyCurrent())},
        {QStringLiteral("voltage"), rounded(joint.volts())},
        {QStringLiteral("windingTemperature"), rounded(joint.warmth().winding())},
        {QStringLiteral("caseTemperature"), rounded(joint.warmth().body())},
        {QStringLiteral("ambient"), rounded(joint.warmth().ambient())},
        {QStringLiteral("inertia"), plant.inertia()},
    };
    const auto insertAngle = [&state](const char16_t *key, std::optional<double> angle) {
        if (angle)
            state.insert(QString::fromUtf16(key), degrees(*angle));
    };
    insertAngle(u"heldAt", load.heldAt());
    insertAngle(u"lowestStop", load.lowestStop());
    insertAngle(u"highestStop", load.highestStop());
    return state;
}

/// Lit where any of its colours is.
QString led(Servo &servo)
{
    if (!servo.isPowered())
        return QStringLiteral("off");
    if (servo.isShutDown())
        return QStringLiteral("blinking");
    for (const Field &field : servo.table().fields()) {
        if ((field.name == u"LED" || field.name.startsWith(u"LED ")) && servo.value(field) != 0)
            return QStringLiteral("on");
    }
    return QStringLiteral("off");
}

bool isModelled(const ControlTable &table, const Field &field)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(Reg::Count); ++i) {
        if (findRegister(table, static_cast<Reg>(i)) == &field)
            return true;
    }
    return field.name.startsWith(u"Indirect ") || field.name.startsWith(u"LED") || field.name == u"Model Information";
}

/// Registers that are there, are read and written, and do nothing: external ports, a dynamic brake.
QJsonArray notModelled(const ControlTable &table)
{
    constexpr std::array<int, 3> driveModes{0, 2, 3}; // bits: direction, time-based profile, torque on by goal
    QJsonArray names;
    for (const Field &field : table.fields()) {
        if (!isModelled(table, field))
            names.append(field.name);
        if (&field != findRegister(table, Reg::DriveMode))
            continue;
        for (const BitField &bit : field.bits) {
            if (std::ranges::find(driveModes, bit.first) == driveModes.end())
                names.append(QStringLiteral("%1: %2").arg(field.name, bit.name));
        }
    }
    return names;
}

} // namespace

QJsonObject truth(Servo &servo)
{
    QJsonObject registers;
    for (const Field &field : servo.table().fields())
        registers.insert(field.name, static_cast<qint64>(servo.value(field)));
    const MotorModel &motor = servo.joint().plant().motor();
    return {
        {QStringLiteral("model"), servo.model()},
        {QStringLiteral("firmware"), servo.firmware()},
        {QStringLiteral("id"), servo.id()},
        {QStringLiteral("baudRate"), servo.baudRate()},
        {QStringLiteral("power"), servo.isPowered()},
        {QStringLiteral("deaf"), servo.isDeaf(servo.now())},
        {QStringLiteral("torque"), servo.joint().torque()},
        {QStringLiteral("led"), led(servo)},
        {QStringLiteral("shutDown"), servo.isShutDown()},
        {QStringLiteral("hardwareErrors"), QJsonArray::fromStringList(servo.errors().names())},
        {QStringLiteral("physical"), physical(servo.joint())},
        {QStringLiteral("motor"),
         QJsonObject{{QStringLiteral("name"), motor.name},
                     {QStringLiteral("known"), QJsonArray::fromStringList(motor.knownFigures())},
                     {QStringLiteral("chosen"), QJsonArray::fromStringList(motor.chosenFigures())}}},
        {QStringLiteral("notModelled"), notModelled(servo.table())},
        {QStringLiteral("registers"), registers},
    };
}

QJsonObject truth(const SimulatedBus &bus)
{
    QJsonArray supplies, servos;
    for (const auto &supply : bus.power().supplies())
        supplies.append(QJsonObject{{QStringLiteral("voltage"), supply->voltage()},
                                    {QStringLiteral("resistance"), supply->resistance()},
                                    {QStringLiteral("terminalVoltage"), rounded(supply->terminalVoltage())},
                                    {QStringLiteral("current"), rounded(supply->current())}});
    for (const auto &servo : bus.servos())
        servos.append(truth(*servo));
    return {
        {QStringLiteral("time"), rounded(std::chrono::duration<double, std::milli>(bus.now()).count())},
        {QStringLiteral("power"),
         QJsonObject{{QStringLiteral("on"), bus.power().isOn()}, {QStringLiteral("supplies"), supplies}}},
        {QStringLiteral("servos"), servos},
    };
}

} // namespace dynascope::sim
