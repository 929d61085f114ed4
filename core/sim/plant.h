// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/motor.h"

namespace dynascope::sim {

/// Winding and case, two heat stores in a row; stepped by hundreds of milliseconds.
class Warmth
{
public:
    Warmth(const MotorModel &motor, double ambient);

    /// Heat over `seconds`: `winding` W in the copper, `body` W in gears and electronics. Stable for any duration.
    void step(double seconds, double winding, double body);
    void setAmbient(double celsius) { m_ambient = celsius; }
    double winding() const { return m_winding; } ///< °C
    double body() const { return m_body; }       ///< °C, of the case

private:
    double m_windingHeat, m_windingToCase, m_caseHeat, m_caseToAmbient;
    double m_ambient, m_winding, m_body;
};

/// Shaft, motor and supply: angle, speed and current in the shaft's own direction, in SI units. The winding's inductance
/// is left out (its time constant is a tenth of a millisecond). Implicit Euler, so no step is too long to be stable.
class Plant
{
public:
    explicit Plant(const MotorModel &motor);

    /// `duty` −1..1; without `driven` the bridge is open and no current flows.
    void step(double seconds, double duty, bool driven);

    const MotorModel &motor() const { return m_motor; }
    double angle() const { return m_angle; }     ///< rad
    double speed() const { return m_speed; }     ///< rad/s
    double current() const { return m_current; } ///< A in the winding
    double terminalVoltage() const { return m_terminal; } ///< V, what the servo sees of its supply
    double supplyVoltage() const { return m_supply; }     ///< V, without load
    double copperPower() const { return m_current * m_current * m_motor.resistance(); } ///< W
    double bodyPower() const; ///< W

    void setAngle(double radians); ///< jumps there and stands
    void turnBack(double radians) { m_angle -= radians; } ///< renames the angle; nothing moves
    void setLoadTorque(double newtonMetres);
    void setGravityArm(double newtonMetres);
    void setExtraInertia(double kilogramSquareMetres);
    void setSupplyVoltage(double volts);

    /// Ω of wires and supply. Chosen: two metres of the usual cable and a small supply.
    static constexpr double supplyResistance = 0.1;

private:
    void settleSupply(double duty, bool driven);

    MotorModel m_motor;
    double m_angle = 0, m_speed = 0, m_current = 0, m_terminal = 0;
    double m_supply = 12, m_load = 0, m_gravity = 0, m_inertia = 0;
    double m_resistance = 1, m_torqueConstant = 1, m_backEmf = 1; ///< of m_motor, at hand
};

} // namespace dynascope::sim
