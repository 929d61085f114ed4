// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/motionregisters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace dynascope::sim {
namespace {

constexpr int WheelMode = 1, JointMode = 2; ///< of Control Mode
constexpr int Unlimited = std::numeric_limits<int>::max();
constexpr std::int64_t SignBit = 1024;      ///< of a signed quantity in an unsigned register
constexpr int TimeBased = 4;                ///< bit of Drive Mode
constexpr int OffsetsPerTurnInPositionMode = 4; ///< offsets beyond a quarter of a turn don't count there

// Other series scale their gains otherwise, and say less of it. Chosen: factory gains ask for 25/s times the error as a
// speed, for all the PWM at 5.6 times the free speed, and the integral reaches all the PWM after 151 ms of an error of
// the free speed, which is about what those of XM430 do. A register's value counts by its share of the factory value.
constexpr double PositionRate = 25, VelocityShare = 0.18, IntegralTime = 151; // 1/s, share, ms
constexpr double PositionPScale = 128, VelocityPScale = 128, VelocityIScale = 65536;

double scaleOf(const RegisterFile &registers, Reg reg, Unit unit, double fallback)
{
    const Field *field = registers.field(reg);
    return field && field->unit == unit && field->scale > 0 ? field->scale : fallback;
}

std::int64_t signedValue(const RegisterFile &registers, Reg reg)
{
    const Field *field = registers.field(reg);
    const std::int64_t raw = registers.get(reg);
    if (!field || field->isSigned || raw < SignBit)
        return raw;
    return -(raw - SignBit);
}

void setSigned(RegisterFile &registers, Reg reg, std::int64_t value)
{
    const Field *field = registers.field(reg);
    if (field && !field->isSigned)
        value = std::min(std::abs(value), SignBit - 1) + (value < 0 ? SignBit : 0);
    registers.set(reg, value);
}

} // namespace

MotionRegisters::MotionRegisters(RegisterFile &registers, const MotorModel &motor, std::uint64_t seed)
    : m_registers(registers)
    , m_joint(motor, seed)
{
    const QString &series = registers.table().description().series;
    m_xGains = series == u"X" || series == u"MX(2.0)";
    if (const Field *status = registers.field(Reg::MovingStatus); status && !status->bits.empty()) {
        m_statusMask = 0;
        for (const BitField &bit : status->bits)
            m_statusMask |= ((std::int64_t(1) << bit.count) - 1) << bit.first;
    }
    configure();
    m_joint.setShaftAngle(startAngle());
    bringIntoOneTurn();
}

/// Degrees: half a turn, unless the factory limits put that out of reach.
double MotionRegisters::startAngle() const
{
    const double turn = m_registers.table().resolution();
    const auto lowest = static_cast<double>(m_registers.initial(Reg::MinPositionLimit));
    const auto highest = static_cast<double>(m_registers.initial(Reg::MaxPositionLimit));
    const bool outside = highest > lowest && (turn / 2 > highest || turn / 2 < lowest || lowest < 0);
    return outside ? (lowest + highest) / 2 / turn * 360 : 180;
}

void MotionRegisters::beginAt(LineTime now)
{
    m_joint.beginAt(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

void MotionRegisters::advanceTo(LineTime now)
{
    m_joint.advanceTo(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

int MotionRegisters::operatingMode() const
{
    const Field *mode = m_registers.field(Reg::OperatingMode);
    const auto value = static_cast<int>(m_registers.get(Reg::OperatingMode));
    if (!mode)
        return PositionMode;
    if (mode->name != u"Control Mode")
        return value;
    return value == WheelMode ? VelocityMode : value == JointMode ? PositionMode : value;
}

JointSettings MotionRegisters::gains() const
{
    const auto number = [this](Reg reg) { return static_cast<int>(m_registers.get(reg)); };
    JointSettings settings;
    settings.operatingMode = operatingMode();
    settings.driveMode = static_cast<std::uint8_t>(number(Reg::DriveMode));
    settings.positionP = number(Reg::PositionPGain);
    settings.positionI = number(Reg::PositionIGain);
    settings.positionD = number(Reg::PositionDGain);
    settings.feedforward1 = number(Reg::Feedforward1stGain);
    settings.feedforward2 = number(Reg::Feedforward2ndGain);
    // A model without velocity gains (XL-320) has a controller nevertheless.
    settings.velocityP = m_registers.has(Reg::VelocityPGain) ? number(Reg::VelocityPGain) : 1;
    settings.velocityI = m_registers.has(Reg::VelocityIGain) ? number(Reg::VelocityIGain) : 1;
    return settings;
}

void MotionRegisters::setBounds(JointSettings &settings) const
{
    const auto number = [this](Reg reg, int otherwise) {
        const std::int64_t value = std::clamp<std::int64_t>(m_registers.get(reg), -Unlimited, Unlimited);
        return m_registers.has(reg) ? static_cast<int>(value) : otherwise;
    };
    if (const Field *limit = m_registers.field(Reg::PwmLimit); limit && limit->maximum.number.value_or(0) > 0)
        settings.fullPwm = static_cast<double>(*limit->maximum.number);
    settings.pwmLimit = number(Reg::PwmLimit, static_cast<int>(settings.fullPwm));
    settings.goalPwm = number(Reg::GoalPwm, settings.pwmLimit);
    settings.velocityLimit = std::max(0, number(Reg::VelocityLimit, Unlimited));
    settings.goalVelocity = static_cast<int>(std::clamp<std::int64_t>(
        signedValue(m_registers, Reg::GoalVelocity), -settings.velocityLimit, settings.velocityLimit));
    settings.currentLimit = number(Reg::CurrentLimit, settings.currentLimit);
    settings.goalCurrent = number(Reg::GoalCurrent, settings.currentLimit);
    settings.limitsEveryCurrent = m_registers.has(Reg::CurrentLimit)
                                  && !m_joint.plant().motor().isKnown(MotorModel::StallCurrent);
    settings.pwmSlope = number(Reg::PwmSlope, 0) * scaleOf(m_registers, Reg::PwmSlope, Unit::MilliVoltPerMs, 1) / 1000;
}

void MotionRegisters::setProfile(JointSettings &settings) const
{
    const auto number = [this](Reg reg) { return static_cast<int>(m_registers.get(reg)); };
    // Where there is no Profile Velocity, the goal's velocity is that of the way to it.
    settings.profileVelocity =
        m_registers.has(Reg::ProfileVelocity) ? number(Reg::ProfileVelocity) : std::abs(settings.goalVelocity);
    settings.profileAcceleration = number(Reg::ProfileAcceleration);
    if ((settings.driveMode & TimeBased) && m_registers.has(Reg::ProfileTime)) {
        settings.profileVelocity = number(Reg::ProfileTime);
        settings.profileAcceleration = number(Reg::ProfileAccelerationTime);
        settings.timeUnit = scaleOf(m_registers, Reg::ProfileTime, Unit::Millisecond, 1);
    }
    if (m_registers.has(Reg::MovingThreshold)) {
        const double unit = scaleOf(m_registers, Reg::MovingThreshold, Unit::RevPerMin, settings.velocityUnit);
        settings.movingThreshold = static_cast<int>(
            std::lround(std::min(number(Reg::MovingThreshold) * unit / settings.velocityUnit, 1e9)));
    }
    settings.inPosition = static_cast<double>(m_registers.get(Reg::InPositionThreshold));
    settings.following = static_cast<double>(m_registers.get(Reg::FollowingErrorThreshold));
}

void MotionRegisters::setUnits(JointSettings &settings) const
{
    settings.resolution = m_registers.table().resolution();
    settings.currentUnit = scaleOf(m_registers, Reg::PresentCurrent, Unit::MilliAmpere, settings.currentUnit);
    settings.velocityUnit = scaleOf(m_registers, Reg::PresentVelocity, Unit::RevPerMin, settings.velocityUnit);
    settings.accelerationUnit =
        scaleOf(m_registers, Reg::ProfileAcceleration, Unit::RevPerMin2, settings.accelerationUnit);
    if (m_xGains)
        return;
    const MotorModel &motor = m_joint.plant().motor();
    const auto factory = [this](Reg reg) { return std::max(1.0, static_cast<double>(m_registers.initial(reg))); };
    const double perRadian = PositionRate / motor.freeRadians() * settings.fullPwm;
    const double pulsesPerRadian = settings.resolution / 6.283185307179586;
    const double freeRaw = motor.freeSpeed / settings.velocityUnit;
    settings.positionGain = perRadian / pulsesPerRadian * PositionPScale / factory(Reg::PositionPGain);
    settings.velocityPGain = VelocityShare * settings.fullPwm / freeRaw * VelocityPScale / factory(Reg::VelocityPGain);
    settings.velocityIGain =
        settings.fullPwm / (IntegralTime * freeRaw) * VelocityIScale / factory(Reg::VelocityIGain);
}

void MotionRegisters::configure()
{
    JointSettings settings = gains();
    setBounds(settings);
    setUnits(settings);
    setProfile(settings);
    m_joint.configure(settings);
}

void MotionRegisters::setTorque(bool on)
{
    m_joint.setTorque(on);
    if (!on)
        return;
    if (operatingMode() == VelocityMode)
        takeGoalVelocity();
    else
        takeGoalPosition();
}

void MotionRegisters::takeGoalPosition()
{
    m_joint.setGoalPosition(toJoint(m_registers.get(Reg::GoalPosition)));
}

void MotionRegisters::takeGoalVelocity()
{
    m_joint.setGoalVelocity(m_joint.settings().goalVelocity);
}

void MotionRegisters::holdStill()
{
    m_joint.stopMotion();
}

void MotionRegisters::bringIntoOneTurn()
{
    const std::int64_t turn = m_registers.table().resolution();
    // Where the factory limits lie on both sides of 0, so does the turn.
    const std::int64_t lowest = m_registers.initial(Reg::MinPositionLimit) < 0 ? -(turn / 2) : 0;
    const std::int64_t position = m_joint.state().position;
    const std::int64_t within = (((position - lowest) % turn) + turn) % turn + lowest;
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
    if (operatingMode() == PositionMode)
        bringIntoOneTurn();
    m_registers.set(Reg::GoalPosition, presentPosition());
}

void MotionRegisters::publish()
{
    const JointState state = m_joint.state();
    const auto raw = [this](Reg reg, Unit unit, double value) {
        return static_cast<std::int64_t>(std::lround(value / scaleOf(m_registers, reg, unit, 1)));
    };
    m_registers.set(Reg::Moving, state.moving ? 1 : 0);
    m_registers.set(Reg::MovingStatus, state.movingStatus & m_statusMask);
    m_registers.set(Reg::PresentPwm, state.pwm);
    setSigned(m_registers, Reg::PresentCurrent, state.current);
    setSigned(m_registers, Reg::PresentLoad, state.load);
    setSigned(m_registers, Reg::PresentVelocity, state.velocity);
    std::int64_t position = toPresent(state.position);
    // Two bytes without a sign (XL-320) count within one turn.
    if (const Field *field = m_registers.field(Reg::PresentPosition); field && field->size == 2 && !field->isSigned) {
        const std::int64_t turn = m_registers.table().resolution();
        position = ((position % turn) + turn) % turn;
    }
    m_registers.set(Reg::PresentPosition, position);
    m_registers.set(Reg::VelocityTrajectory, state.velocityTrajectory);
    m_registers.set(Reg::PositionTrajectory, toPresent(state.positionTrajectory));
    m_registers.set(Reg::PresentInputVoltage, raw(Reg::PresentInputVoltage, Unit::Volt, state.inputVoltage));
    const std::int64_t warmest = m_registers.field(Reg::PresentTemperature)
                                     ? largestRaw(*m_registers.field(Reg::PresentTemperature)) : 0;
    m_registers.set(Reg::PresentTemperature,
                    std::clamp<std::int64_t>(std::lround(state.temperature), 0, warmest));
}

std::int32_t MotionRegisters::presentPosition() const
{
    return toPresent(m_joint.state().position);
}

std::int64_t MotionRegisters::homingOffset() const
{
    const std::int64_t offset = m_registers.get(Reg::HomingOffset);
    const int most = m_registers.table().resolution() / OffsetsPerTurnInPositionMode;
    return operatingMode() == PositionMode && std::abs(offset) > most ? 0 : offset;
}

} // namespace dynascope::sim
