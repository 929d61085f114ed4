// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/joint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope::sim {

namespace {

constexpr double tickSeconds = 0.001; ///< a step of the supply
constexpr int substeps = 2;

constexpr int heatPeriod = 100; ///< ticks between two reckonings of the temperatures
constexpr double roomTemperature = 25;
constexpr double voltsOfRest = 0.001; ///< a change of the supply that a resting joint feels

std::optional<double> radians(std::optional<double> degrees)
{
    return degrees ? std::optional(*degrees * std::numbers::pi / 180) : std::nullopt;
}

} // namespace

Joint::Joint(const MotorModel &motor, std::uint64_t seed)
    : m_plant(motor)
    , m_warmth(motor, roomTemperature)
    , m_controller(motor)
    , m_own(motor.voltage)
    , m_seed(seed)
    , m_volts(motor.voltage)
    , m_restVolts(motor.voltage)
{
    m_plant.setAngle(std::numbers::pi); // the middle of the range, 2048 pulses
    hold();
}

const JointTuning &Joint::tuning() const
{
    static const JointTuning usual;
    return m_tuning ? *m_tuning : usual;
}

void Joint::beginAt(std::int64_t microseconds)
{
    m_tick = m_origin = m_start = microseconds / 1000;
    m_own.beginAt(m_tick);
}

void Joint::share(Supply *supply)
{
    if (m_shared)
        m_shared->remove(*this);
    m_shared = supply;
    if (supply)
        supply->add(*this);
    else
        m_own.beginAt(m_tick);
    wake();
}

void Joint::advanceTo(std::int64_t microseconds)
{
    Joint *self = this;
    if (m_shared)
        m_shared->advance(m_shared->joints(), microseconds / 1000);
    else
        m_own.advance({&self, 1}, microseconds / 1000);
}

/// The controllers, before the step.
void Joint::control()
{
    const Controller before = m_controller;
    const double pwmBefore = m_pwm;
    const bool freeOrder = m_settings.operatingMode == 0 || m_settings.operatingMode == 16;
    const bool loop = m_tick % std::max(1, tuning().loopTime) == 0;
    if (!m_torque || (m_stopped && freeOrder)) {
        m_pwm = 0;
    } else if (loop) {
        Feedback feedback;
        feedback.position = present();
        feedback.velocity = direction() * m_velocity;
        feedback.current = direction() * m_plant.current();
        feedback.voltage = m_volts;
        feedback.wanted = trajectory();
        m_pwm = m_controller.pwm(m_settings, tuning(), feedback);
    }
    m_changing = !loop || m_pwm != pwmBefore || m_controller != before;
}

/// duty² / R of the winding is what the bridge shows to the supply; back-EMF takes from it.
Joint::Draw Joint::draw() const
{
    if (!m_powered)
        return {};
    Draw draw{0, 0, m_plant.motor().standbyCurrent};
    if (m_torque) {
        draw.conductance = duty() * duty() / m_plant.resistance();
        draw.feedback = duty() * m_plant.backEmf() * m_plant.speed() / m_plant.resistance();
    }
    return draw;
}

double Joint::supplyCurrent() const
{
    const Draw own = draw();
    return own.conductance * m_volts - own.feedback + own.standby;
}

void Joint::feel(double volts)
{
    m_volts = volts;
    if (std::abs(volts - m_restVolts) > voltsOfRest)
        wake();
}

/// Where Current Limit always holds, the bridge itself keeps it, quicker than the controllers.
double Joint::boundedDuty() const
{
    if (!m_settings.limitsEveryCurrent || m_volts <= 0)
        return duty();
    const double emf = m_plant.backEmf() * m_plant.speed() / m_volts;
    const double room = m_settings.currentLimit * m_settings.currentUnit / 1000 * m_plant.resistance() / m_volts;
    return std::clamp(std::clamp(duty(), emf - std::abs(room), emf + std::abs(room)), -1.0, 1.0);
}

void Joint::move()
{
    const int overloadBefore = m_overloadTicks;
    const bool pushed = m_plant.load().changesByItself();
    for (int i = 0; i < substeps; ++i)
        m_plant.step(tickSeconds / substeps, boundedDuty(), m_volts, m_torque);
    m_plant.load().passTime(tickSeconds);
    // The share of the new makes a filter of that time constant.
    const double share = 1 / (0.5 + std::max(0.5, tuning().velocityFilter));
    m_velocity += (m_plant.speed() * pulsesPerRadian() / 1000 - m_velocity) * share;
    if (m_plant.speed() == 0 && std::abs(m_velocity) < 2.4e-8 * m_settings.resolution)
        m_velocity = 0;
    watchLoad();
    heat(1);
    ++m_tick;
    m_restVolts = m_volts;
    m_resting = m_velocity == 0 && m_plant.speed() == 0 && !m_changing && m_overloadTicks == overloadBefore
                && !profileOngoing() && !pushed;
}

void Joint::rest(std::int64_t ticks)
{
    heat(ticks);
    m_tick += ticks;
}

void Joint::watchLoad()
{
    const bool heavy = std::abs(m_plant.current()) > m_plant.motor().overloadCurrent;
    const int longest = static_cast<int>(tamed(tuning().overloadTime, 1e8));
    m_overloadTicks = std::clamp(m_overloadTicks + (heavy ? 1 : -1), 0, std::max(1, longest));
}

void Joint::heat(std::int64_t ticks)
{
    const double standby = m_powered ? m_volts * m_plant.motor().standbyCurrent : 0.0;
    const double copper = m_plant.copperPower(), body = m_plant.frictionPower() + standby;
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
    wake();
}

void Joint::configure(const JointSettings &settings)
{
    const JointSettings old = m_settings;
    m_settings = settings;
    m_settings.resolution = std::max(1, settings.resolution);
    m_settings.fullPwm = settings.fullPwm > 0 ? settings.fullPwm : 1;
    wake();
    if (old.operatingMode != settings.operatingMode || (old.driveMode & 1) != (settings.driveMode & 1)
        || old.resolution != settings.resolution)
        hold();
    if (old.goalPwm != settings.goalPwm || old.goalCurrent != settings.goalCurrent)
        m_stopped = false;
    if (old.goalVelocity != settings.goalVelocity)
        setGoalVelocity(settings.goalVelocity);
}

void Joint::setTorque(bool on)
{
    on = on && m_powered;
    if (m_torque == on)
        return;
    m_torque = on;
    m_pwm = 0;
    m_plant.letGo();
    hold();
}

void Joint::setPowered(bool powered)
{
    m_powered = powered;
    if (!powered)
        setTorque(false);
    wake();
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
    const double goal = raw * m_settings.velocityUnit * m_settings.resolution / 60000;
    m_ramp = VelocityRamp(trajectory().velocity, goal, limits());
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
    const double turns = std::floor(present() / m_settings.resolution);
    m_plant.turnBack(direction() * turns * 2 * std::numbers::pi);
    m_profile.shift(-turns * m_settings.resolution);
}

void Joint::setLoadTorque(double newtonMetres)
{
    m_plant.load().setTorque(newtonMetres);
    wake();
}

void Joint::setGravityArm(double newtonMetres)
{
    m_plant.load().setGravityArm(newtonMetres);
    wake();
}

void Joint::setExtraInertia(double kilogramSquareMetres)
{
    m_plant.load().setInertia(kilogramSquareMetres);
    wake();
}

void Joint::setStops(std::optional<double> lowest, std::optional<double> highest)
{
    m_plant.load().setStops(radians(lowest), radians(highest));
    wake();
}

void Joint::push(double newtonMetres, double seconds)
{
    m_plant.load().push(newtonMetres, seconds);
    wake();
}

void Joint::hold(std::optional<double> degrees)
{
    m_plant.load().hold(radians(degrees));
    wake();
}

void Joint::setAmbientTemperature(double celsius)
{
    m_warmth.setAmbient(celsius);
}

void Joint::setShaftAngle(double degrees)
{
    m_plant.setAngle(degrees * std::numbers::pi / 180);
    m_velocity = 0;
    hold();
}

} // namespace dynascope::sim
