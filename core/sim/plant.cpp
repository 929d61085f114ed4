// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/plant.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

/// Contacts are stiff: the stall torque dents them by one degree. Chosen.
constexpr double DentOfStallTorque = 0.017453292519943295; // rad

/// What stands, or all but stands, is held by more dry friction than what moves. Chosen.
constexpr double Stiction = 1.3, Creeping = 0.002; // of the dry friction; rad/s

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

void Warmth::setAmbient(double celsius)
{
    m_ambient = std::max(-273.0, tamed(celsius, 1000));
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
    , m_load(motor.stallTorque / DentOfStallTorque)
    , m_resistance(motor.resistance())
    , m_torqueConstant(motor.torqueConstant())
    , m_backEmf(motor.backEmf())
{
}

void Plant::step(double seconds, double duty, double volts, bool driven)
{
    // What depends on the angle is taken in the middle of the step.
    const Load::Effect load = m_load.at(m_angle + m_speed * seconds / 2, m_speed, inertia());
    double push = load.torque, drag = load.drag + m_motor.viscous;
    if (driven) {
        push += m_torqueConstant * duty * volts / m_resistance;
        drag += m_torqueConstant * m_backEmf / m_resistance;
    }
    move(push, drag, seconds);
    m_current = driven ? (duty * volts - m_backEmf * m_speed) / m_resistance : 0.0;
}

/// inertia × speed' = push − drag × speed, less dry friction, which also holds what it can stop.
void Plant::move(double push, double drag, double seconds)
{
    constexpr double Undamped = 1e-9; // rate × time below which a straight line is as good
    const double rate = drag / inertia();
    for (int part = 0; part < 2; ++part) { // dry friction turns round where the motion does
        if (std::abs(m_speed) < Creeping && std::abs(push) <= Stiction * m_motor.coulomb) {
            m_speed = 0;
            return;
        }
        const double sign = m_speed != 0 ? std::copysign(1.0, m_speed) : std::copysign(1.0, push);
        const double net = push - sign * m_motor.coulomb;
        const bool damped = rate * seconds > Undamped;
        const double settled = damped ? net / drag : 0.0;
        const double decay = damped ? std::exp(-rate * seconds) : 1.0;
        const double speed = damped ? settled + (m_speed - settled) * decay : m_speed + net / inertia() * seconds;
        if (speed * sign >= 0) {
            m_angle += damped ? settled * seconds + (m_speed - settled) * (1 - decay) / rate
                              : (m_speed + speed) / 2 * seconds;
            m_speed = speed;
            return;
        }
        const double until = damped ? std::log((m_speed - settled) / -settled) / rate : -m_speed * inertia() / net;
        m_angle += damped ? settled * until + m_speed / rate : m_speed / 2 * until;
        m_speed = 0;
        seconds -= std::clamp(until, 0.0, seconds);
    }
}

double Plant::frictionPower() const
{
    return (m_motor.coulomb + m_motor.viscous * std::abs(m_speed)) * std::abs(m_speed);
}

void Plant::setAngle(double radians)
{
    m_angle = tamed(radians, 1e9);
    m_speed = 0;
}

} // namespace dynascope::sim
