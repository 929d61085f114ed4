// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controller.h"

#include "core/sim/motor.h"

#include <algorithm>
#include <cmath>

namespace dynascope::sim {

namespace {

// Register scalings, manual: "Position PID Gain", "Feedforward", "Velocity PI Gain". What errors are counted in isn't
// documented: JointTuning.
constexpr double positionPScale = 128, positionIScale = 65536, positionDScale = 16, feedforwardScale = 4;
constexpr double velocityPScale = 128, velocityIScale = 65536;

/// ms the current loop takes to make up for back-EMF. Chosen: quick in current mode; in current-based position control
/// slower than the shaft swings, so that back-EMF still damps it: its default gains have no other damping.
constexpr double currentModeTime = 3, currentPositionTime = 100;

double within(double value, double bound)
{
    return std::clamp(value, -bound, bound);
}

double pwmBound(const JointSettings &settings)
{
    const double limit = std::min(std::abs(double(settings.pwmLimit)), settings.fullPwm);
    // In PWM mode Goal PWM is the order itself, and its limit bounds it.
    return settings.operatingMode == 16 ? limit : std::min(limit, std::abs(double(settings.goalPwm)));
}

} // namespace

Controller::Controller(const MotorModel &motor)
    : m_resistance(motor.resistance())
{
}

double Controller::pwm(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback)
{
    double next = order(settings, tuning, feedback);
    if (settings.pwmSlope > 0) {
        const double perVolt = settings.fullPwm / std::max(1.0, feedback.voltage);
        const double most = settings.pwmSlope * std::max(1, tuning.loopTime) * perVolt;
        next = std::clamp(next, m_last - most, m_last + most);
    }
    m_last = next;
    return m_last;
}

double Controller::order(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback)
{
    const double bound = pwmBound(settings);
    const double ampere = settings.currentUnit / 1000;
    const double limit = std::abs(settings.currentLimit * ampere);
    switch (settings.operatingMode) {
    case 0: {
        const double wanted = within(settings.goalCurrent * ampere, limit);
        return current(settings, wanted, std::abs(wanted), currentModeTime, feedback, bound);
    }
    case 1:
        return velocity(settings, tuning, feedback, bound);
    case 5: {
        const double ceiling = std::min(limit, std::abs(settings.goalCurrent * ampere));
        if (ampere <= 0)
            return 0;
        // The position controller's output counts as raw current.
        const double wanted = position(settings, tuning, feedback, ceiling / ampere) * ampere;
        return current(settings, wanted, ceiling, currentPositionTime, feedback, bound);
    }
    case 16:
        return within(settings.goalPwm, bound);
    default:
        return position(settings, tuning, feedback, bound);
    }
}

double Controller::position(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback,
                            double bound)
{
    const double unit = settings.positionGain / (tuning.positionErrorUnit > 0 ? tuning.positionErrorUnit : 1);
    const double loop = std::max(1, tuning.loopTime); // ms: rates are per loop
    const double error = (feedback.wanted.position - feedback.position) * unit;
    m_integral = within(m_integral + error * settings.positionI / positionIScale, bound);
    return within(error * settings.positionP / positionPScale + m_integral
                      + (feedback.wanted.velocity - feedback.velocity) * unit * loop * settings.positionD
                            / positionDScale
                      + feedback.wanted.velocity * unit * loop * settings.feedforward1 / feedforwardScale
                      + feedback.wanted.acceleration * unit * loop * loop * settings.feedforward2 / feedforwardScale,
                  bound);
}

double Controller::velocity(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback,
                            double bound)
{
    if (settings.velocityUnit <= 0)
        return 0;
    const double count = tuning.velocityErrorUnit > 0 ? tuning.velocityErrorUnit : 1;
    const double raw = 60000.0 / settings.resolution / settings.velocityUnit / count; // per pulse/ms
    const double error = (feedback.wanted.velocity - feedback.velocity) * raw;
    m_integral = within(m_integral + error * settings.velocityIGain * settings.velocityI / velocityIScale, bound);
    return within(error * settings.velocityPGain * settings.velocityP / velocityPScale + m_integral, bound);
}

double Controller::current(const JointSettings &settings, double wanted, double ceiling, double integralTime,
                           const Feedback &feedback, double bound)
{
    const double perVolt = settings.fullPwm / std::max(1.0, feedback.voltage);
    const double error = (wanted - feedback.current) * m_resistance * perVolt;
    // What keeps the current below its ceiling at this speed, also while braking. The last PWM and the current it
    // brought tell back-EMF a few milliseconds before the velocity estimate does.
    const double emf = m_last - feedback.current * m_resistance * perVolt;
    const double room = ceiling * m_resistance * perVolt;
    const double feed = wanted * m_resistance * perVolt;
    const double pwm = within(std::clamp(feed + m_currentIntegral, emf - room, emf + room), bound);
    // The sum stands still while the output can't follow it.
    const double next = m_currentIntegral + error / integralTime;
    if (std::abs(feed + next) <= bound || std::abs(next) < std::abs(m_currentIntegral))
        m_currentIntegral = within(next, bound);
    return pwm;
}

} // namespace dynascope::sim
