// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/jointvalues.h"
#include "core/sim/profile.h"

namespace dynascope::sim {

struct MotorModel;

/// What the servo's sensors and its profile generator tell its controllers, in the direction Drive Mode gives.
struct Feedback {
    double position = 0; ///< pulses, whole ones as the encoder gives them
    double velocity = 0; ///< pulses/ms, as the servo estimates it
    double current = 0;  ///< A
    double voltage = 12; ///< V of the supply
    TrajectoryPoint wanted; ///< in velocity mode its velocity alone
};

/// The controllers of an X servo, one call each loop. No cascade: each mode is one controller that gives PWM (or
/// a current, for the current loop), and Goal PWM bounds the PWM in every mode. Manual: "Position PID Gain", "Velocity
/// PI Gain", "Operating Mode". A value.
class Controller
{
public:
    explicit Controller(const MotorModel &motor);

    void reset() { m_integral = m_currentIntegral = m_last = 0; }
    /// Raw, within its bounds.
    double pwm(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback);

    friend bool operator==(const Controller &, const Controller &) = default;

private:
    double order(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback);
    double position(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback, double bound);
    double velocity(const JointSettings &settings, const JointTuning &tuning, const Feedback &feedback, double bound);
    double current(const JointSettings &settings, double wanted, double ceiling, double integralTime,
                   const Feedback &feedback, double bound);

    double m_resistance;      ///< Ω
    double m_integral = 0;    ///< already in units of the output, so that a new gain doesn't make it jump
    double m_currentIntegral = 0; ///< raw PWM
    double m_last = 0;            ///< raw PWM of the loop before
};

} // namespace dynascope::sim
