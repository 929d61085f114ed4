// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/plant.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

/// Numbers from outside: a value that is none becomes 0, a monstrous one is cut, so that nothing here can overflow.
double tame(double value, double limit)
{
    return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
}

} // namespace

Warmth::Warmth(const MotorModel &motor, double ambient)
    : m_windingHeat(motor.windingHeat)
    , m_windingToCase(motor.windingToCase)
    , m_caseHeat(motor.caseHeat)
    , m_caseToAmbient(motor.caseToAmbient)
    , m_ambient(ambient)
    // Powered for a while already: the electronics keep it a little above its surroundings.
    , m_winding(ambient + motor.voltage * motor.standbyCurrent * motor.caseToAmbient)
    , m_body(m_winding)
{
}

void Warmth::step(double seconds, double winding, double body)
{
    // Implicit Euler of the two equations, solved for the case first.
    const double across = 1 / m_windingToCase, out = 1 / m_caseToAmbient;
    const double w = m_windingHeat / seconds, c = m_caseHeat / seconds;
    const double share = across / (w + across); // of the case's temperature in the winding's
    const double alone = (w * m_winding + winding) / (w + across);
    m_body = (c * m_body + body + out * m_ambient + across * alone) / (c + out + across * (1 - share));
    m_winding = alone + share * m_body;
}

Plant::Plant(const MotorModel &motor)
    : m_motor(motor)
    , m_terminal(motor.voltage)
    , m_supply(motor.voltage)
    , m_inertia(motor.inertia)
    , m_resistance(motor.resistance())
    , m_torqueConstant(motor.torqueConstant())
    , m_backEmf(motor.backEmf())
{
    settleSupply(0, false);
}

void Plant::step(double seconds, double duty, bool driven)
{
    // A bridge that is on draws duty × current from the supply, so the supply's resistance acts as duty² of it.
    const double resistance = m_resistance + supplyResistance * duty * duty;
    double push = m_load, drag = m_motor.viscous;
    if (driven) {
        push += m_torqueConstant * duty * m_supply / resistance;
        drag += m_torqueConstant * m_backEmf / resistance;
    }
    if (m_gravity != 0)
        push -= m_gravity * std::cos(m_angle);

    const double inertia = m_inertia / seconds;
    const double free = (inertia * m_speed + push) / (inertia + drag);
    // Dry friction takes away as much speed as it can, and holds what it can stop.
    const double grip = m_motor.coulomb / (inertia + drag);
    const double speed = std::abs(free) <= grip ? 0.0 : free - std::copysign(grip, free);
    m_angle += speed * seconds;
    m_speed = speed;
    m_current = driven ? (duty * m_supply - m_backEmf * speed) / resistance : 0.0;
    settleSupply(duty, driven);
}

void Plant::settleSupply(double duty, bool driven)
{
    const double drawn = (driven ? duty * m_current : 0.0) + m_motor.standbyCurrent;
    m_terminal = m_supply - supplyResistance * drawn;
}

double Plant::bodyPower() const
{
    const double friction = (m_motor.coulomb + m_motor.viscous * std::abs(m_speed)) * std::abs(m_speed);
    return friction + m_supply * m_motor.standbyCurrent;
}

void Plant::setAngle(double radians)
{
    m_angle = tame(radians, 1e9);
    m_speed = 0;
}

void Plant::setLoadTorque(double newtonMetres)
{
    m_load = tame(newtonMetres, 1000);
}

void Plant::setGravityArm(double newtonMetres)
{
    m_gravity = tame(newtonMetres, 1000);
}

void Plant::setExtraInertia(double kilogramSquareMetres)
{
    m_inertia = m_motor.inertia + std::max(0.0, tame(kilogramSquareMetres, 1000));
}

void Plant::setSupplyVoltage(double volts)
{
    m_supply = std::max(0.0, tame(volts, 100));
    settleSupply(0, false);
}

} // namespace dynascope::sim
