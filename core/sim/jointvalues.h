// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace dynascope::sim {

/// The registers that steer motion, in the manufacturer's raw units, and what the units are.
struct JointSettings {
    /// 0 current, 1 velocity, 3 position, 4 extended position, 5 current-based position, 16 PWM
    int operatingMode = 3;
    std::uint8_t driveMode = 0; ///< bit 0 reverse, bit 2 time-based profile
    int positionP = 800, positionI = 0, positionD = 0, feedforward1 = 0, feedforward2 = 0;
    int velocityP = 100, velocityI = 1920;
    int pwmLimit = 885, currentLimit = 1193, velocityLimit = 1023;
    int goalPwm = 885, goalCurrent = 1193, goalVelocity = 0;
    int profileVelocity = 0, profileAcceleration = 0;
    int movingThreshold = 10;
    double inPosition = 0, following = 0; ///< pulses; 0: as JointTuning says

    int resolution = 4096;      ///< pulses per turn
    double fullPwm = 885;       ///< raw at 100 %
    double currentUnit = 2.69;  ///< mA per raw
    double velocityUnit = 0.229; ///< rev/min per raw
    double accelerationUnit = 214.577; ///< rev/min² per raw
    double timeUnit = 1;        ///< ms per raw, of a time-based profile
    double pwmSlope = 0;        ///< V/ms, the steepest change of the motor's voltage; 0: any
    double positionGain = 1, velocityPGain = 1, velocityIGain = 1; ///< of the X series' meaning of the gains
    bool limitsEveryCurrent = false; ///< Current Limit holds in all modes
};

/// What the manual leaves open about control: users' reports and guesses, to be confirmed on hardware.
struct JointTuning {
    int loopTime = 1;               ///< ms between two runs of the controllers; sums and rates are per loop
    double positionErrorUnit = 1;   ///< pulses that the position controller counts as one
    double velocityErrorUnit = 1;   ///< raw units of Present Velocity that the velocity controller counts as one
    double velocityFilter = 5;      ///< ms, time constant of the velocity estimate
    double inPosition = 1.758;      ///< degrees from the goal: Moving Status bit 0
    double following = 17.58;       ///< degrees from the trajectory: Moving Status bit 3
    double overloadTime = 1000;     ///< ms above the motor's overload current until it is an overload
    bool profileObeysVelocityLimit = true;
    bool profileNeedsVelocity = false; ///< with Profile Velocity 0 there is none, whatever the acceleration
};

/// What the servo's registers say of its motion, in the manufacturer's raw units.
struct JointState {
    std::int32_t position = 0;  ///< pulses, without Homing Offset, in the direction Drive Mode gives; many turns
    int velocity = 0, current = 0, pwm = 0;
    int load = 0;               ///< 0.1 %
    std::int32_t positionTrajectory = 0;
    int velocityTrajectory = 0;
    bool moving = false;
    std::uint8_t movingStatus = 0; ///< bits as the register
    double inputVoltage = 12;   ///< V
    double temperature = 30;    ///< °C, of the case
    bool overload = false;      ///< condition, not yet latched
};

} // namespace dynascope::sim
