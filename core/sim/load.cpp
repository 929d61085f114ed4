// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/load.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

constexpr double Strongest = 1000, Heaviest = 1000, Farthest = 1e9, Longest = 86400; // N·m, kg·m², rad, s

/// Of the critical damping: what hits a stop bounces a little, what a hand holds doesn't swing. Chosen.
constexpr double StopDamping = 0.5, HandDamping = 1.0;

std::optional<double> tamedAngle(std::optional<double> angle)
{
    return angle && std::isfinite(*angle) ? std::optional(tamed(*angle, Farthest)) : std::nullopt;
}

} // namespace

double tamed(double value, double limit)
{
    return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0;
}

void Load::setTorque(double newtonMetres)
{
    m_torque = tamed(newtonMetres, Strongest);
}

void Load::setGravityArm(double newtonMetresAtHorizontal)
{
    m_gravity = tamed(newtonMetresAtHorizontal, Strongest);
}

void Load::setInertia(double kilogramSquareMetres)
{
    m_inertia = std::max(0.0, tamed(kilogramSquareMetres, Heaviest));
}

void Load::setStops(std::optional<double> lowest, std::optional<double> highest)
{
    m_lowest = tamedAngle(lowest);
    m_highest = tamedAngle(highest);
    if (m_lowest && m_highest && *m_lowest > *m_highest)
        std::swap(m_lowest, m_highest);
}

void Load::push(double newtonMetres, double seconds)
{
    m_push = tamed(newtonMetres, Strongest);
    m_pushLeft = std::max(0.0, tamed(seconds, Longest));
}

void Load::hold(std::optional<double> angle)
{
    m_held = tamedAngle(angle);
}

/// Pushes back from `depth`, and damps on the way in only: a stop doesn't hold on to what leaves it.
Load::Effect Load::contact(double depth, double speed, double inertia) const
{
    const bool deeper = (speed > 0) == (depth > 0);
    return {-m_stiffness * depth, deeper ? 2 * StopDamping * std::sqrt(m_stiffness * inertia) : 0.0};
}

Load::Effect Load::at(double angle, double speed, double inertia) const
{
    Effect sum{m_torque + handTorque(), 0};
    const auto add = [&sum](const Effect &effect) {
        sum.torque += effect.torque;
        sum.drag += effect.drag;
    };
    if (m_gravity != 0)
        sum.torque -= m_gravity * std::cos(angle);
    if (m_highest && angle > *m_highest)
        add(contact(angle - *m_highest, speed, inertia));
    if (m_lowest && angle < *m_lowest)
        add(contact(angle - *m_lowest, speed, inertia));
    if (m_held)
        add({-m_stiffness * (angle - *m_held), 2 * HandDamping * std::sqrt(m_stiffness * inertia)});
    return sum;
}

} // namespace dynascope::sim
