// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/supply.h"

#include "core/sim/joint.h"

#include <algorithm>

namespace dynascope::sim {

namespace {

constexpr std::int64_t WatchPeriod = 10; ///< ms: how late a servo may notice a fault
constexpr double HighestVoltage = 100, HighestResistance = 1000;

} // namespace

Supply::Supply(double volts, double ohms)
{
    setVoltage(volts);
    setResistance(ohms);
    m_terminal = m_volts;
}

void Supply::setVoltage(double volts)
{
    m_volts = std::max(0.0, tamed(volts, HighestVoltage));
}

void Supply::setResistance(double ohms)
{
    m_ohms = std::max(0.0, tamed(ohms, HighestResistance));
}

void Supply::add(Joint &joint)
{
    m_joints.push_back(&joint);
}

void Supply::remove(Joint &joint)
{
    std::erase(m_joints, &joint);
}

/// Each joint draws conductance × voltage − feedback + standby.
void Supply::settle(std::span<Joint *const> joints)
{
    double conductance = 0, feedback = 0, standby = 0;
    for (const Joint *joint : joints) {
        const Joint::Draw draw = joint->draw();
        conductance += draw.conductance;
        feedback += draw.feedback;
        standby += draw.standby;
    }
    const double open = m_on ? m_volts : 0.0;
    m_terminal = m_on ? std::max(0.0, (open + m_ohms * (feedback - standby)) / (1 + m_ohms * conductance)) : 0.0;
    m_current = m_on ? conductance * m_terminal - feedback + standby : 0.0;
    for (Joint *joint : joints)
        joint->feel(m_terminal);
}

void Supply::step(std::span<Joint *const> joints)
{
    for (Joint *joint : joints)
        joint->control();
    settle(joints);
    for (Joint *joint : joints)
        joint->move();
    ++m_tick;
}

void Supply::advance(std::span<Joint *const> joints, std::int64_t milliseconds)
{
    const bool watched = std::ranges::any_of(joints, &Joint::isWatched);
    while (m_tick < milliseconds) {
        const bool resting = std::ranges::all_of(joints, &Joint::isResting);
        if (resting)
            settle(joints); // who feels another voltage rests no longer
        if (resting && std::ranges::all_of(joints, &Joint::isResting)) {
            const std::int64_t watch = m_tick - m_tick % WatchPeriod + WatchPeriod;
            const std::int64_t until = watched ? std::min(milliseconds, watch) : milliseconds;
            for (Joint *joint : joints)
                joint->rest(until - m_tick);
            m_tick = until;
        } else {
            step(joints);
        }
        if (m_tick % WatchPeriod != 0)
            continue;
        for (Joint *joint : joints)
            joint->watch(m_tick);
    }
}

} // namespace dynascope::sim
