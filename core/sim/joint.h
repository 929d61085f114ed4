// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/controller.h"
#include "core/sim/plant.h"
#include "core/sim/profile.h"

#include <cstdint>

namespace dynascope::sim {

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
    /// Turning on holds still, in position and velocity modes, until a goal is set; Goal PWM and Goal Current act at once.
    void setTorque(bool on);
    bool torque() const { return m_torque; }
    /// Begins a profile from where the trajectory is now. In the same frame as JointState::position. Without torque, or in
    /// a mode without positions, nothing.
    void setGoalPosition(std::int32_t pulses);
    void setGoalVelocity(int raw); ///< velocity mode: uses Profile Acceleration alone
    void stopMotion(); ///< Bus Watchdog: hold still until a goal is set or changes, or endStop()
    void endStop() { m_stopped = m_resting = false; } ///< Goal PWM and Goal Current act again
    /// Power-on, or torque on in Position mode: whole turns are forgotten, position is 0..4095 again. Nothing moves.
    void reduceToOneTurn();

    JointState state() const;

    /// @name The world around it
    /// @{
    void setLoadTorque(double newtonMetres); ///< constant external torque
    /// Pulls with torque × cos(angle) towards −90° (270°), horizontal being 0° and 180°; 0: none.
    void setGravityArm(double newtonMetresAtHorizontal);
    void setExtraInertia(double kilogramSquareMetres);
    void setSupplyVoltage(double volts);
    void setAmbientTemperature(double celsius);
    void setShaftAngle(double degrees); ///< jump there; for starting positions
    /// @}

private:
    void tick();
    void hold();
    void heat(std::int64_t ticks);
    void watchLoad();
    int noise(std::uint64_t channel) const;
    double present() const;
    double presentVelocity() const;
    TrajectoryPoint trajectory() const;
    ProfileLimits limits() const;
    bool profileOngoing() const;
    std::uint8_t movingStatus() const;
    bool positionMode() const { return m_settings.operatingMode >= 3 && m_settings.operatingMode <= 5; }
    double direction() const { return m_settings.driveMode & 1 ? -1.0 : 1.0; }

    JointSettings m_settings;
    Plant m_plant;
    Warmth m_warmth;
    Controller m_controller;
    PositionProfile m_profile;
    VelocityRamp m_ramp;
    std::uint64_t m_seed;
    std::int64_t m_tick = 0;  ///< ms on the bus's clock; what comes in between two of them acts from the later on
    std::int64_t m_start = 0; ///< of the profile or ramp
    double m_velocity = 0;    ///< pulses/ms, the estimate, in the shaft's direction
    double m_pwm = 0;         ///< raw, as the register
    double m_copperHeat = 0, m_bodyHeat = 0; ///< W × ms since the temperatures were last reckoned
    int m_heatTicks = 0, m_overloadTicks = 0;
    bool m_torque = false, m_stopped = false;
    bool m_resting = false; ///< the next tick would change nothing but temperatures
};

} // namespace dynascope::sim
