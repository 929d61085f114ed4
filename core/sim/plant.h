// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/load.h"
#include "core/sim/motor.h"

namespace dynascope::sim {

/// Winding and case, two heat stores in a row; stepped by hundreds of milliseconds.
class Warmth
{
public:
    Warmth(const MotorModel &motor, double ambient);

    /// Heat over `seconds`: `winding` W in the copper, `body` W in gears and electronics. Stable for any duration.
    void step(double seconds, double winding, double body);
    void setAmbient(double celsius);
    double ambient() const { return m_ambient; } ///< °C
    double winding() const { return m_winding; } ///< °C
    double body() const { return m_body; }       ///< °C, of the case

private:
    double m_windingHeat, m_windingToCase, m_caseHeat, m_caseToAmbient;
    double m_ambient, m_winding, m_body;
};

/// Shaft and motor: angle, speed and current in the shaft's own direction, in SI units. The winding's inductance is
/// left out (its time constant is a tenth of a millisecond). Within a step torques and drag are constant, and the
/// motion is exact; so no step is too long to be stable. A value.
class Plant
{
public:
    explicit Plant(const MotorModel &motor);

    /// `duty` −1..1 of `volts`; without `driven` the bridge is open and no current flows.
    void step(double seconds, double duty, double volts, bool driven);

    const MotorModel &motor() const { return m_motor; }
    Load &load() { return m_load; }
    const Load &load() const { return m_load; }
    double angle() const { return m_angle; }     ///< rad
    double speed() const { return m_speed; }     ///< rad/s
    double current() const { return m_current; } ///< A in the winding
    double inertia() const { return m_motor.inertia + m_load.inertia(); } ///< kg·m²
    double motorTorque() const { return m_torqueConstant * m_current; }   ///< N·m, friction not taken off
    double copperPower() const { return m_current * m_current * m_resistance; } ///< W
    double frictionPower() const;                                               ///< W
    double resistance() const { return m_resistance; }
    double backEmf() const { return m_backEmf; } ///< V·s/rad

    void setAngle(double radians); ///< jumps there and stands
    void turnBack(double radians) { m_angle -= radians; } ///< renames the angle; nothing moves
    void letGo() { m_current = 0; }                       ///< the bridge opens

private:
    void move(double push, double drag, double seconds);

    MotorModel m_motor;
    Load m_load;
    double m_angle = 0, m_speed = 0, m_current = 0;
    double m_resistance, m_torqueConstant, m_backEmf; ///< of m_motor, at hand
};

} // namespace dynascope::sim
