// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <cstdint>

namespace dynascope::sim {

/// The electric motor with its gearbox, at the output shaft, as data sheets state it. See motor.h for the models.
struct MotorModel;

/// The registers that steer motion, in the manufacturer's raw units.
struct JointSettings {
    int operatingMode = 3;      ///< 0 current, 1 velocity, 3 position, 4 extended position, 5 current-based position, 16 PWM
    std::uint8_t driveMode = 0; ///< bit 0 reverse, bit 2 time-based profile
    int positionP = 800, positionI = 0, positionD = 0, feedforward1 = 0, feedforward2 = 0;
    int velocityP = 100, velocityI = 1920;
    int pwmLimit = 885, currentLimit = 1193, velocityLimit = 200;
    int goalPwm = 885, goalCurrent = 1193, goalVelocity = 0;
    int profileVelocity = 0, profileAcceleration = 0;
    int movingThreshold = 10;
    double currentUnit = 2.69;  ///< mA per raw
    double velocityUnit = 0.229; ///< rev/min per raw
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
    int inputVoltage = 120;     ///< 0.1 V
    int temperature = 30;       ///< °C, of the case
    bool overload = false;      ///< condition, not yet latched
};

/// One joint's physics and controllers: a linear DC motor, inertia, friction, a load, integrated in steps of at most 1 ms
/// up to *now* when somebody asks. Deterministic. Any one thread.
class Joint
{
public:
    Joint(const MotorModel &motor, std::uint64_t seed = 1);

    /// Microseconds on the bus's clock; never goes back.
    void advanceTo(std::int64_t microseconds);

    void configure(const JointSettings &settings); ///< after any of those registers was written
    const JointSettings &settings() const { return m_settings; }
    void setTorque(bool on);
    bool torque() const { return m_torque; }
    /// Begins a profile from where the trajectory is now. In the same frame as JointState::position.
    void setGoalPosition(std::int32_t pulses);
    void setGoalVelocity(int raw); ///< velocity mode: uses Profile Acceleration alone
    void stopMotion();             ///< Bus Watchdog: hold still

    JointState state() const;

    /// @name The world around it
    /// @{
    void setLoadTorque(double newtonMetres); ///< constant external torque
    void setGravityArm(double newtonMetresAtHorizontal); ///< torque × cos(angle); 0: none
    void setExtraInertia(double kilogramSquareMetres);
    void setSupplyVoltage(double volts);
    void setAmbientTemperature(double celsius);
    void setShaftAngle(double degrees); ///< jump there; for starting positions
    /// @}

    // The owner of this file chooses the representation.
private:
    JointSettings m_settings;
    bool m_torque = false;
};

} // namespace dynascope::sim
