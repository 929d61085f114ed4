// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/profile.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

PositionProfile::PositionProfile(double position) : m_start(position), m_goal(position) { }

PositionProfile::PositionProfile(const TrajectoryPoint &from, double goal, const ProfileLimits &limits)
    : m_start(from.position)
    , m_startVelocity(from.velocity)
    , m_goal(goal)
{
    const double distance = goal - from.position;
    if (limits.timeBased)
        planTimed(distance, limits);
    else
        plan(distance, limits);
}

void PositionProfile::plan(double distance, const ProfileLimits &limits)
{
    const double a = limits.acceleration;
    if (a <= 0) {
        if (limits.velocity <= 0 || distance == 0)
            return; // a step: there at once
        m_shape = ProfileShape::Rectangle;
        m_cruiseVelocity = std::copysign(limits.velocity, distance);
        m_cruise = distance / m_cruiseVelocity;
        return;
    }
    if (distance == 0 && m_startVelocity == 0)
        return;
    // Braking at once would end at `stop`: the goal is on that side, also when it means turning round.
    const double v0 = m_startVelocity;
    const double stop = v0 * std::abs(v0) / (2 * a);
    const double side = distance >= stop ? 1.0 : -1.0;
    const double peak = std::sqrt(std::max(0.0, side * distance * a + v0 * v0 / 2));
    const bool reached = limits.velocity > 0 && limits.velocity <= peak;
    m_cruiseVelocity = side * (reached ? limits.velocity : peak);
    m_ramp = std::abs(m_cruiseVelocity - v0) / a;
    m_brake = std::abs(m_cruiseVelocity) / a;
    const double left = distance - (v0 + m_cruiseVelocity) / 2 * m_ramp - m_cruiseVelocity / 2 * m_brake;
    if (reached)
        m_cruise = std::max(0.0, left / m_cruiseVelocity);
    m_shape = reached ? ProfileShape::Trapezoid : ProfileShape::Triangle;
}

void PositionProfile::planTimed(double distance, const ProfileLimits &limits)
{
    const double whole = limits.velocity;
    if (whole <= 0 || (distance == 0 && m_startVelocity == 0))
        return;
    m_ramp = m_brake = std::clamp(limits.acceleration, 0.0, whole / 2);
    m_cruise = whole - 2 * m_ramp;
    m_cruiseVelocity = (distance - m_startVelocity * m_ramp / 2) / (whole - m_ramp);
    if (m_ramp <= 0)
        m_shape = ProfileShape::Rectangle;
    else
        m_shape = m_cruise > 0 ? ProfileShape::Trapezoid : ProfileShape::Triangle;
}

TrajectoryPoint PositionProfile::at(double t) const
{
    if (t >= duration())
        return {m_goal, 0, 0};
    const double v = m_cruiseVelocity;
    if (t < m_ramp) {
        const double a = (v - m_startVelocity) / m_ramp;
        return {m_start + (m_startVelocity + a * t / 2) * t, m_startVelocity + a * t, a};
    }
    const double left = duration() - t;
    if (left >= m_brake)
        return {m_goal - v * m_brake / 2 - v * (left - m_brake), v, 0};
    const double a = v / m_brake;
    return {m_goal - a * left * left / 2, a * left, -a};
}

VelocityRamp::VelocityRamp(double from, double goal, const ProfileLimits &limits) : m_from(from), m_goal(goal)
{
    if (limits.acceleration <= 0 || from == goal)
        return;
    m_duration = limits.timeBased ? limits.acceleration : std::abs(goal - from) / limits.acceleration;
}

double VelocityRamp::at(double t) const
{
    return t >= m_duration ? m_goal : m_from + (m_goal - m_from) * t / m_duration;
}

} // namespace dynascope::sim
