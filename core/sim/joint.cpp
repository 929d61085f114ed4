// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

constexpr double pi = 3.14159265358979;
constexpr double resolution = 4096; ///< pulses per turn, of all X servos
constexpr double pulsesPerRadian = resolution / (2 * pi);

constexpr double tickSeconds = 0.001; ///< the controllers' loop
constexpr int substeps = 2;

/// Share of the new in the velocity estimate each tick: a filter of about 5 ms. Chosen.
constexpr double velocityShare = 0.18;

/// rev/min² per unit of Profile Acceleration, manual: "Profile Acceleration".
constexpr double accelerationUnit = 214.577;

constexpr int heatPeriod = 100; ///< ticks between two reckonings of the temperatures
constexpr double roomTemperature = 25;

// Chosen, pulses: Moving Status bits 0 and 3, which the manual describes without figures.
constexpr double inPosition = 20, following = 200;

// Chosen: more than this share of the data sheet's stall current, for so many ticks, is an overload.
constexpr double overloadShare = 0.6;
constexpr int overloadDelay = 1000;

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

Joint::Joint(const MotorModel &motor, std::uint64_t seed)
    : m_plant(motor)
    , m_warmth(motor, roomTemperature)
    , m_controller(motor, resolution)
    , m_seed(seed)
{
    m_plant.setAngle(pi); // the middle of the range, 2048 pulses
    hold();
}

void Joint::advanceTo(std::int64_t microseconds)
{
    const std::int64_t target = microseconds / 1000;
    while (m_tick < target) {
        if (m_resting) {
            heat(target - m_tick);
            m_tick = target;
            return;
        }
        tick();
    }
}

void Joint::tick()
{
    const double sign = direction();
    const Controller before = m_controller;
    const double pwmBefore = m_pwm;
    const int overloadBefore = m_overloadTicks;

    m_pwm = 0;
    const bool freeOrder = m_settings.operatingMode == 0 || m_settings.operatingMode == 16;
    if (m_torque && !(m_stopped && freeOrder)) {
        Feedback feedback;
        feedback.position = present();
        feedback.velocity = sign * m_velocity;
        feedback.current = sign * m_plant.current();
        feedback.voltage = m_plant.terminalVoltage();
        feedback.wanted = trajectory();
        m_pwm = m_controller.pwm(m_settings, feedback);
    }
    for (int i = 0; i < substeps; ++i)
        m_plant.step(tickSeconds / substeps, sign * m_pwm / Controller::fullPwm, m_torque);

    m_velocity += (m_plant.speed() * pulsesPerRadian / 1000 - m_velocity) * velocityShare;
    if (m_plant.speed() == 0 && std::abs(m_velocity) < 1e-4)
        m_velocity = 0;
    watchLoad();
    heat(1);
    ++m_tick;
    m_resting = m_velocity == 0 && m_plant.speed() == 0 && m_pwm == pwmBefore && m_controller == before
        && m_overloadTicks == overloadBefore && !profileOngoing();
}

void Joint::watchLoad()
{
    const bool heavy = std::abs(m_plant.current()) > overloadShare * m_plant.motor().stallCurrent;
    m_overloadTicks = std::clamp(m_overloadTicks + (heavy ? 1 : -1), 0, overloadDelay);
}

void Joint::heat(std::int64_t ticks)
{
    const double copper = m_plant.copperPower(), body = m_plant.bodyPower();
    while (ticks > 0) {
        const auto part = static_cast<int>(std::min<std::int64_t>(ticks, heatPeriod - m_heatTicks));
        m_copperHeat += copper * part;
        m_bodyHeat += body * part;
        m_heatTicks += part;
        ticks -= part;
        if (m_heatTicks < heatPeriod)
            return;
        const Warmth before = m_warmth;
        m_warmth.step(heatPeriod * tickSeconds, m_copperHeat / heatPeriod, m_bodyHeat / heatPeriod);
        m_copperHeat = m_bodyHeat = 0;
        m_heatTicks = 0;
        // Nothing changes any more: whole periods may be left out.
        if (std::abs(m_warmth.body() - before.body()) < 1e-9 && std::abs(m_warmth.winding() - before.winding()) < 1e-9)
            ticks %= heatPeriod;
    }
}

void Joint::hold()
{
    m_controller.reset();
    m_profile = PositionProfile(present());
    m_ramp = VelocityRamp();
    m_start = m_tick;
    m_stopped = false;
    m_resting = false;
}

void Joint::configure(const JointSettings &settings)
{
    const JointSettings old = m_settings;
    m_settings = settings;
    m_resting = false;
    if (old.operatingMode != settings.operatingMode || (old.driveMode & 1) != (settings.driveMode & 1))
        hold();
    if (old.goalPwm != settings.goalPwm || old.goalCurrent != settings.goalCurrent)
        m_stopped = false;
    if (old.goalVelocity != settings.goalVelocity)
        setGoalVelocity(settings.goalVelocity);
}

void Joint::setTorque(bool on)
{
    if (m_torque == on)
        return;
    m_torque = on;
    m_pwm = 0;
    hold();
}

void Joint::setGoalPosition(std::int32_t pulses)
{
    if (!m_torque || !positionMode())
        return;
    m_profile = PositionProfile(trajectory(), pulses, limits());
    m_start = m_tick;
    m_stopped = m_resting = false;
}

void Joint::setGoalVelocity(int raw)
{
    if (!m_torque || m_settings.operatingMode != 1)
        return;
    m_ramp = VelocityRamp(trajectory().velocity, raw * m_settings.velocityUnit * resolution / 60000, limits());
    m_start = m_tick;
    m_stopped = m_resting = false;
}

void Joint::stopMotion()
{
    hold();
    m_stopped = true;
}

void Joint::reduceToOneTurn()
{
    const double turns = std::floor(present() / resolution);
    m_plant.turnBack(direction() * turns * 2 * pi);
    m_profile.shift(-turns * resolution);
}

double Joint::present() const
{
    return direction() * std::round(m_plant.angle() * pulsesPerRadian);
}

double Joint::presentVelocity() const
{
    return direction() * m_velocity * 60000 / resolution / std::max(1e-6, m_settings.velocityUnit);
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
    limits.velocity = std::max(0, m_settings.profileVelocity);
    limits.acceleration = std::max(0, m_settings.profileAcceleration);
    if (!limits.timeBased) {
        limits.velocity *= m_settings.velocityUnit * resolution / 60000;
        limits.acceleration *= accelerationUnit * resolution / (60000.0 * 60000.0);
    }
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
    unsigned status = profileOngoing() ? 2 : 0;
    if (m_torque && positionMode()) {
        if (std::abs(m_profile.goal() - present()) <= inPosition)
            status |= 1;
        if (std::abs(trajectory().position - present()) > following)
            status |= 8;
        status |= static_cast<unsigned>(m_profile.shape()) << 4;
    }
    return static_cast<std::uint8_t>(status);
}

/// −1, 0 or 1, mostly 0; of the moment, so that asking more often doesn't change what comes.
int Joint::noise(std::uint64_t channel) const
{
    std::uint64_t x = m_seed * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(m_tick) * 4 + channel;
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
    const double rawPerVelocity = 60000 / resolution / std::max(1e-6, m_settings.velocityUnit);
    const double milliamperes = direction() * m_plant.current() * 1000;

    JointState state;
    state.position = toRegister(present());
    state.velocity = rounded(presentVelocity(), 1e9) + (m_velocity != 0 ? noise(0) : 0);
    state.current = rounded(milliamperes / std::max(1e-6, m_settings.currentUnit), 32767) + (m_torque ? noise(1) : 0);
    state.pwm = rounded(m_pwm, Controller::fullPwm);
    // As XL430 gives it; that it is the share of the stall current is chosen.
    state.load = rounded(milliamperes / m_plant.motor().stallCurrent, 1000);
    state.positionTrajectory = toRegister(wanted.position);
    state.velocityTrajectory = rounded(wanted.velocity * rawPerVelocity, 1e9);
    state.moving = std::abs(state.velocity) > m_settings.movingThreshold || profileOngoing();
    state.movingStatus = movingStatus();
    state.inputVoltage = rounded(m_plant.terminalVoltage() * 10, 1000);
    state.temperature = rounded(m_warmth.body(), 1000);
    state.overload = m_overloadTicks >= overloadDelay;
    return state;
}

void Joint::setLoadTorque(double newtonMetres)
{
    m_plant.setLoadTorque(newtonMetres);
    m_resting = false;
}

void Joint::setGravityArm(double newtonMetresAtHorizontal)
{
    m_plant.setGravityArm(newtonMetresAtHorizontal);
    m_resting = false;
}

void Joint::setExtraInertia(double kilogramSquareMetres)
{
    m_plant.setExtraInertia(kilogramSquareMetres);
    m_resting = false;
}

void Joint::setSupplyVoltage(double volts)
{
    m_plant.setSupplyVoltage(volts);
    m_resting = false;
}

void Joint::setAmbientTemperature(double celsius)
{
    m_warmth.setAmbient(celsius);
}

void Joint::setShaftAngle(double degrees)
{
    m_plant.setAngle(degrees * pi / 180);
    m_velocity = 0;
    hold();
}

} // namespace dynascope::sim
