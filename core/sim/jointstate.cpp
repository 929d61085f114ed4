// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

constexpr unsigned InPosition = 1, ProfileOngoing = 2, NotFollowing = 8; ///< of Moving Status
constexpr int ProfileShapeBit = 4;

std::int32_t toRegister(double pulses)
{
    // Past 32 bits the register wraps round, as a counter does.
    const double bounded = std::clamp(pulses, -9e18, 9e18);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(bounded)));
}

int rounded(double value, double limit)
{
    return static_cast<int>(std::lround(std::clamp(value, -limit, limit)));
}

} // namespace

double Joint::present() const
{
    return direction() * std::round(m_plant.angle() * pulsesPerRadian());
}

double Joint::presentVelocity() const
{
    return direction() * m_velocity * 60000 / m_settings.resolution / std::max(1e-6, m_settings.velocityUnit);
}

TrajectoryPoint Joint::trajectory() const
{
    const auto since = static_cast<double>(m_tick - m_start);
    if (m_torque && positionMode())
        return m_profile.at(since);
    if (m_torque && m_settings.operatingMode == 1)
        return {present(), m_ramp.at(since), 0};
    return {present(), 0, 0};
}

ProfileLimits Joint::limits() const
{
    ProfileLimits limits;
    limits.timeBased = m_settings.driveMode & 4;
    int velocity = std::max(0, m_settings.profileVelocity);
    limits.acceleration = std::max(0, m_settings.profileAcceleration);
    if (limits.timeBased) {
        limits.velocity = velocity * m_settings.timeUnit;
        limits.acceleration *= m_settings.timeUnit;
        return limits;
    }
    // Manual: "Profile Velocity" can't exceed Velocity Limit.
    if (tuning().profileObeysVelocityLimit && m_settings.velocityLimit > 0)
        velocity = std::min(velocity, m_settings.velocityLimit);
    if (tuning().profileNeedsVelocity && velocity == 0 && positionMode())
        limits.acceleration = 0;
    limits.velocity = velocity * m_settings.velocityUnit * m_settings.resolution / 60000;
    limits.acceleration *= m_settings.accelerationUnit * m_settings.resolution / (60000.0 * 60000.0);
    return limits;
}

bool Joint::profileOngoing() const
{
    const auto since = static_cast<double>(m_tick - m_start);
    if (!m_torque)
        return false;
    return positionMode() ? since < m_profile.duration()
                          : m_settings.operatingMode == 1 && since < m_ramp.duration();
}

std::uint8_t Joint::movingStatus() const
{
    unsigned status = profileOngoing() ? ProfileOngoing : 0;
    if (m_torque && positionMode()) {
        const double perDegree = m_settings.resolution / 360.0;
        const double near = m_settings.inPosition > 0 ? m_settings.inPosition : tuning().inPosition * perDegree;
        const double far = m_settings.following > 0 ? m_settings.following : tuning().following * perDegree;
        if (std::abs(m_profile.goal() - present()) <= near)
            status |= InPosition;
        if (std::abs(trajectory().position - present()) > far)
            status |= NotFollowing;
        status |= static_cast<unsigned>(m_profile.shape()) << ProfileShapeBit;
    }
    return static_cast<std::uint8_t>(status);
}

/// −1, 0 or 1, mostly 0; of the moment, so that asking more often doesn't change what comes.
int Joint::noise(std::uint64_t channel) const
{
    std::uint64_t x = m_seed * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(m_tick - m_origin) * 4 + channel;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    switch ((x >> 61) & 7) {
    case 0: return -1;
    case 1: return 1;
    default: return 0;
    }
}

JointState Joint::state() const
{
    const TrajectoryPoint wanted = trajectory();
    const double rawPerVelocity = 60000.0 / m_settings.resolution / std::max(1e-6, m_settings.velocityUnit);
    const double milliamperes = direction() * m_plant.current() * 1000;

    JointState state;
    state.position = toRegister(present());
    state.velocity = rounded(presentVelocity(), 1e9) + (m_velocity != 0 ? noise(0) : 0);
    state.current = rounded(milliamperes / std::max(1e-6, m_settings.currentUnit), 32767) + (m_torque ? noise(1) : 0);
    state.pwm = rounded(m_pwm, m_settings.fullPwm);
    // As XL430 gives it; that it is the share of the stall current is chosen.
    state.load = rounded(milliamperes / m_plant.motor().stallCurrent, 1000);
    state.positionTrajectory = toRegister(wanted.position);
    state.velocityTrajectory = rounded(wanted.velocity * rawPerVelocity, 1e9);
    state.moving = std::abs(state.velocity) > m_settings.movingThreshold || profileOngoing();
    state.movingStatus = movingStatus();
    state.inputVoltage = m_volts;
    state.temperature = m_warmth.body();
    state.overload = m_overloadTicks >= tuning().overloadTime;
    return state;
}

} // namespace dynascope::sim
