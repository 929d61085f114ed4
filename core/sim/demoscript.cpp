// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/demoscript.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope::sim {
namespace {

constexpr double TakingOver = 3.0; ///< s, from where a joint stands into its motion
constexpr int FirstPositionMode = 3, LastPositionMode = 5;

double seconds(LineTime time)
{
    return std::chrono::duration<double>(time).count();
}

} // namespace

void DemoScript::add(Servo &servo, const Part &part)
{
    Joint joint;
    joint.servo = &servo;
    joint.part = part;
    m_joints.push_back(joint);
    servo.setWriteObserver([this](Servo &written, int address, ByteView data) { personWrote(written, address, data); });
}

void DemoScript::personWrote(const Servo &servo, int address, ByteView data)
{
    const Field *torque = servo.table().find(u"Torque Enable");
    const bool torqueOff = torque && torque->address >= address
                           && torque->address < address + static_cast<int>(data.size())
                           && data[static_cast<std::size_t>(torque->address - address)] == 0;
    for (Joint &joint : m_joints) {
        if (torqueOff || joint.servo == &servo)
            joint.held = false;
    }
}

void DemoScript::resume(LineTime now)
{
    if (m_begin == LineTime{})
        m_begin = now;
    for (Joint &joint : m_joints)
        take(joint, now);
}

void DemoScript::take(Joint &joint, LineTime now)
{
    Servo &servo = *joint.servo;
    const std::int64_t mode = servo.value(u"Operating Mode");
    if (joint.held || servo.isDeaf(now) || mode < FirstPositionMode || mode > LastPositionMode)
        return;
    if (servo.value(u"Torque Enable") == 0)
        servo.write(u"Torque Enable", 1);
    servo.write(u"Profile Velocity", joint.part.profileVelocity);
    servo.write(u"Profile Acceleration", joint.part.profileAcceleration);
    joint.from = static_cast<double>(servo.value(u"Present Position"));
    joint.taken = now;
    joint.goal = -1;
    joint.held = true;
}

void DemoScript::tick(LineTime now)
{
    for (Joint &joint : m_joints) {
        // Torque may also go without a write: a reboot, an overload.
        if (joint.held && joint.servo->value(u"Torque Enable") == 0)
            joint.held = false;
        if (joint.held)
            move(joint, now);
    }
}

void DemoScript::move(Joint &joint, LineTime now)
{
    const Part &part = joint.part;
    const double turn = std::sin(2 * std::numbers::pi * (seconds(now - m_begin) / part.period + part.phase));
    const bool profiled = part.profileVelocity != 0 || part.profileAcceleration != 0;
    const double scripted = part.centre + part.amplitude * (profiled ? std::copysign(1.0, turn) : turn);
    const double x = std::clamp(seconds(now - joint.taken) / TakingOver, 0.0, 1.0);
    const double share = profiled ? 1.0 : x * x * (3 - 2 * x);
    const auto goal = static_cast<std::int64_t>(std::lround(joint.from + (scripted - joint.from) * share));
    if (goal != joint.goal && joint.servo->write(u"Goal Position", goal) == DeviceError::None)
        joint.goal = goal;
}

bool DemoScript::isHeld(const Servo &servo) const
{
    return std::ranges::any_of(m_joints, [&](const Joint &joint) { return joint.servo == &servo && joint.held; });
}

} // namespace dynascope::sim
