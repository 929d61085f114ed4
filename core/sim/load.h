// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace dynascope::sim {

/// What a joint's shaft meets outside: constant torque, an arm in gravity, inertia, hard stops, a hand. Angles in rad
/// and torques in N·m, in the shaft's own direction. Numbers from outside are tamed. A value.
class Load
{
public:
    /// `stiffness` N·m/rad: of stops and of a hand that holds.
    explicit Load(double stiffness) : m_stiffness(stiffness) { }

    void setTorque(double newtonMetres);
    void setGravityArm(double newtonMetresAtHorizontal); ///< pulls towards −90°, horizontal being 0° and 180°
    void setInertia(double kilogramSquareMetres);
    void setStops(std::optional<double> lowest, std::optional<double> highest);
    void push(double newtonMetres, double seconds); ///< from now on, in place of a push before
    void hold(std::optional<double> angle);         ///< a hand that keeps it there, or lets go
    void passTime(double seconds) { m_pushLeft = m_pushLeft > seconds ? m_pushLeft - seconds : 0; }

    bool changesByItself() const { return m_pushLeft > 0; }
    double inertia() const { return m_inertia; }
    /// What a spring with a damper exerts is `torque` − `drag` × speed.
    struct Effect {
        double torque = 0, drag = 0;
    };
    /// `inertia`: of all that turns.
    Effect at(double angle, double speed, double inertia) const;

    double torque() const { return m_torque; }
    double gravityArm() const { return m_gravity; }
    double handTorque() const { return m_pushLeft > 0 ? m_push : 0; }
    double pushLeft() const { return m_pushLeft; } ///< s
    std::optional<double> heldAt() const { return m_held; }
    std::optional<double> lowestStop() const { return m_lowest; }
    std::optional<double> highestStop() const { return m_highest; }

private:
    Effect contact(double depth, double speed, double inertia) const;

    double m_stiffness;
    double m_torque = 0, m_gravity = 0, m_inertia = 0, m_push = 0, m_pushLeft = 0;
    std::optional<double> m_lowest, m_highest, m_held;
};

/// Numbers from outside: a value that is none becomes 0, a monstrous one is cut, so that nothing can overflow.
double tamed(double value, double limit);

} // namespace dynascope::sim
