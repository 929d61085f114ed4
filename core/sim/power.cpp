// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/power.h"

#include "core/sim/servo.h"

namespace dynascope::sim {
namespace {

std::int64_t wholeMilliseconds(LineTime time)
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(time).count();
}

/// V; the other way round where the table has no such register.
std::pair<double, double> factoryLimits(const ControlTable &table)
{
    const auto limit = [&table](Reg reg, double otherwise) {
        const Field *field = findRegister(table, reg);
        return field && field->initial ? static_cast<double>(*field->initial) * field->scale : otherwise;
    };
    return {limit(Reg::MinVoltageLimit, 1e9), limit(Reg::MaxVoltageLimit, 0)};
}

/// The data sheet's, or within the limits where the motor isn't known.
double usualVoltage(Servo &servo)
{
    const MotorModel &motor = servo.joint().plant().motor();
    const auto limits = factoryLimits(servo.table());
    const bool within = motor.voltage > limits.first && motor.voltage < limits.second;
    if (motor.isKnown(MotorModel::Voltage) || within || limits.first > limits.second)
        return motor.voltage;
    return (limits.first + limits.second) / 2;
}

} // namespace

Supply &Power::supplyFor(Servo &servo, LineTime now)
{
    if (m_common)
        return *m_supplies.front();
    const double usual = usualVoltage(servo);
    const auto limits = factoryLimits(servo.table());
    for (const auto &supply : m_supplies) {
        const bool allowed = supply->voltage() > limits.first && supply->voltage() < limits.second;
        if (allowed || supply->voltage() == usual)
            return *supply;
    }
    m_supplies.push_back(std::make_unique<Supply>(usual, m_ohms));
    m_supplies.back()->beginAt(wholeMilliseconds(now));
    m_supplies.back()->setOn(m_on);
    return *m_supplies.back();
}

void Power::connect(Servo &servo, LineTime now)
{
    advanceTo(now);
    m_servos.push_back(&servo);
    servo.joint().share(&supplyFor(servo, now));
    servo.followSupply();
}

void Power::beginAt(LineTime now)
{
    for (const auto &supply : m_supplies)
        supply->beginAt(wholeMilliseconds(now));
}

void Power::advanceTo(LineTime now)
{
    for (const auto &supply : m_supplies)
        supply->advance(supply->joints(), wholeMilliseconds(now));
}

void Power::setVoltage(double volts)
{
    if (m_supplies.empty())
        m_supplies.push_back(std::make_unique<Supply>(volts, m_ohms));
    m_common = true;
    m_supplies.front()->setVoltage(volts);
    m_supplies.front()->setOn(m_on);
    for (Servo *servo : m_servos)
        servo->joint().share(m_supplies.front().get());
    m_supplies.resize(1);
}

void Power::setResistance(double ohms)
{
    m_ohms = ohms;
    for (const auto &supply : m_supplies)
        supply->setResistance(ohms);
}

void Power::setOn(bool on)
{
    m_on = on;
    for (const auto &supply : m_supplies)
        supply->setOn(on);
    for (Servo *servo : m_servos)
        servo->followSupply();
}

} // namespace dynascope::sim
