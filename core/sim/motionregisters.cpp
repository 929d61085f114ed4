// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motionregisters.h"

#include <array>
#include <cstdlib>

namespace dynascope::sim {
namespace {

constexpr int VelocityMode = 1;
constexpr int PositionMode = 3;
constexpr std::int32_t LargestOffsetInPositionMode = 1024;

double scaleOf(const RegisterFile &registers, Reg reg, double fallback)
{
    const Field *field = registers.field(reg);
    return field ? field->scale : fallback;
}

} // namespace

MotionRegisters::MotionRegisters(RegisterFile &registers, const MotorModel &motor, std::uint64_t seed)
    : m_registers(registers)
    , m_joint(motor, seed)
{
    configure();
    bringIntoOneTurn();
}

void MotionRegisters::advanceTo(LineTime now)
{
    m_joint.advanceTo(std::chrono::duration_cast<std::chrono::microseconds>(now - m_origin).count());
}

void MotionRegisters::configure()
{
    const auto number = [this](Reg reg) { return static_cast<int>(m_registers.get(reg)); };
    JointSettings settings;
    settings.operatingMode = number(Reg::OperatingMode);
    settings.driveMode = static_cast<std::uint8_t>(number(Reg::DriveMode));
    settings.positionP = number(Reg::PositionPGain);
    settings.positionI = number(Reg::PositionIGain);
    settings.positionD = number(Reg::PositionDGain);
    settings.feedforward1 = number(Reg::Feedforward1stGain);
    settings.feedforward2 = number(Reg::Feedforward2ndGain);
    settings.velocityP = number(Reg::VelocityPGain);
    settings.velocityI = number(Reg::VelocityIGain);
    settings.pwmLimit = number(Reg::PwmLimit);
    settings.velocityLimit = number(Reg::VelocityLimit);
    settings.goalPwm = number(Reg::GoalPwm);
    settings.goalVelocity = number(Reg::GoalVelocity);
    if (m_registers.has(Reg::CurrentLimit)) {
        settings.currentLimit = number(Reg::CurrentLimit);
        settings.goalCurrent = number(Reg::GoalCurrent);
    }
    settings.profileVelocity = number(Reg::ProfileVelocity);
    settings.profileAcceleration = number(Reg::ProfileAcceleration);
    settings.movingThreshold = number(Reg::MovingThreshold);
    settings.currentUnit = scaleOf(m_registers, Reg::PresentCurrent, settings.currentUnit);
    settings.velocityUnit = scaleOf(m_registers, Reg::PresentVelocity, settings.velocityUnit);
    m_joint.configure(settings);
}

void MotionRegisters::setTorque(bool on)
{
    m_joint.setTorque(on);
    if (!on)
        return;
    if (m_registers.get(Reg::OperatingMode) == VelocityMode)
        takeGoalVelocity();
    else
        takeGoalPosition();
}

void MotionRegisters::takeGoalPosition()
{
    m_joint.setGoalPosition(toJoint(static_cast<std::int32_t>(m_registers.get(Reg::GoalPosition))));
}

void MotionRegisters::takeGoalVelocity()
{
    m_joint.setGoalVelocity(static_cast<int>(m_registers.get(Reg::GoalVelocity)));
}

void MotionRegisters::holdStill()
{
    m_joint.stopMotion();
}

void MotionRegisters::bringIntoOneTurn()
{
    const std::int32_t turn = m_registers.table().resolution();
    const std::int32_t position = m_joint.state().position;
    const std::int32_t within = ((position % turn) + turn) % turn;
    m_turns = position - within;
}

void MotionRegisters::changeMode()
{
    constexpr std::array Gains{Reg::VelocityIGain, Reg::VelocityPGain, Reg::PositionDGain, Reg::PositionIGain,
                               Reg::PositionPGain, Reg::Feedforward2ndGain, Reg::Feedforward1stGain};
    for (const Reg gain : Gains)
        m_registers.set(gain, m_registers.initial(gain));
    m_registers.set(Reg::ProfileVelocity, 0);
    m_registers.set(Reg::ProfileAcceleration, 0);
    m_registers.set(Reg::GoalPwm, m_registers.get(Reg::PwmLimit));
    m_registers.set(Reg::GoalCurrent, m_registers.get(Reg::CurrentLimit));
    m_registers.set(Reg::GoalVelocity, 0);
    if (m_registers.get(Reg::OperatingMode) == PositionMode)
        bringIntoOneTurn();
    m_registers.set(Reg::GoalPosition, presentPosition());
}

void MotionRegisters::publish()
{
    const JointState state = m_joint.state();
    m_registers.set(Reg::Moving, state.moving ? 1 : 0);
    m_registers.set(Reg::MovingStatus, state.movingStatus);
    m_registers.set(Reg::PresentPwm, state.pwm);
    m_registers.set(Reg::PresentCurrent, state.current);
    m_registers.set(Reg::PresentLoad, state.load);
    m_registers.set(Reg::PresentVelocity, state.velocity);
    m_registers.set(Reg::PresentPosition, toPresent(state.position));
    m_registers.set(Reg::VelocityTrajectory, state.velocityTrajectory);
    m_registers.set(Reg::PositionTrajectory, toPresent(state.positionTrajectory));
    m_registers.set(Reg::PresentInputVoltage, state.inputVoltage);
    m_registers.set(Reg::PresentTemperature, state.temperature);
}

std::int32_t MotionRegisters::presentPosition() const
{
    return toPresent(m_joint.state().position);
}

std::int32_t MotionRegisters::homingOffset() const
{
    const auto offset = static_cast<std::int32_t>(m_registers.get(Reg::HomingOffset));
    const bool ignored = m_registers.get(Reg::OperatingMode) == PositionMode
                         && std::abs(offset) > LargestOffsetInPositionMode;
    return ignored ? 0 : offset;
}

} // namespace dynascope::sim
