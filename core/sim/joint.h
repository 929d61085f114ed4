// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/controller.h"
#include "core/sim/jointvalues.h"
#include "core/sim/plant.h"
#include "core/sim/profile.h"
#include "core/sim/supply.h"

#include <functional>

namespace dynascope::sim {

/// One joint's physics and controllers: a linear DC motor, inertia, friction, a load, integrated in steps of 0.5 ms up
/// to *now* when somebody asks. Deterministic. Any one thread.
class Joint
{
public:
    explicit Joint(const MotorModel &motor, std::uint64_t seed = 1);
    void beginAt(std::int64_t microseconds); ///< what lies before was nothing
    void advanceTo(std::int64_t microseconds); ///< bus's clock; never back. Takes those on the same supply along

    void configure(const JointSettings &settings); ///< after any of those registers was written
    const JointSettings &settings() const { return m_settings; }
    void useTuning(const JointTuning *tuning) { m_tuning = tuning; } ///< outlives the joint; nullptr: the usual
    /// Turning on holds still until a goal is set; in the modes of Goal PWM and Goal Current these act at once.
    void setTorque(bool on);
    bool torque() const { return m_torque; }
    /// Begins a profile from where the trajectory is now, in the frame of JointState::position. Without torque, or in a
    /// mode without positions, nothing.
    void setGoalPosition(std::int32_t pulses);
    void setGoalVelocity(int raw); ///< velocity mode: uses Profile Acceleration alone
    void stopMotion();             ///< Bus Watchdog: hold still until a goal is set or changes, or endStop()
    void endStop() { m_stopped = m_resting = false; } ///< Goal PWM and Goal Current act again
    /// Power-on, or torque on in Position mode: whole turns are forgotten, position is 0..4095 again. Nothing moves.
    void reduceToOneTurn();

    JointState state() const;
    const Plant &plant() const { return m_plant; }
    const Warmth &warmth() const { return m_warmth; }
    double volts() const { return m_volts; } ///< what it feels of its supply
    double supplyCurrent() const;            ///< A, its share

    /// @name The world around it: degrees, N·m, kg·m², s
    /// @{
    void setLoadTorque(double newtonMetres); ///< constant external torque
    /// Pulls with torque × cos(angle) towards −90° (270°), horizontal being 0° and 180°; 0: none.
    void setGravityArm(double newtonMetresAtHorizontal);
    void setExtraInertia(double kilogramSquareMetres);
    void setStops(std::optional<double> lowest, std::optional<double> highest); ///< stiff; where the shaft can't go
    void push(double newtonMetres, double seconds); ///< a hand, from now on
    void hold(std::optional<double> degrees); ///< a hand that keeps it there, or lets go
    void setAmbientTemperature(double celsius);
    void setShaftAngle(double degrees); ///< jump there; for starting positions
    void setPowered(bool powered);      ///< without power no torque, and its electronics draw nothing
    Supply &supply() { return m_shared ? *m_shared : m_own; } ///< its own unless it shares one
    void share(Supply *supply);                               ///< outlives the joint; nullptr: its own
    void setSupplyVoltage(double volts) { supply().setVoltage(volts); }
    /// Called every 10 ms, at the same moments however often somebody asks.
    void setWatch(std::function<void(std::int64_t milliseconds)> watch) { m_watch = std::move(watch); }
    /// @}

    /// @name For the supply: one step of 1 ms is control(), draw(), feel(), move()
    /// @{
    struct Draw {
        double conductance = 0, feedback = 0, standby = 0; ///< 1/Ω, A, A
    };
    void control();
    Draw draw() const;
    void feel(double volts);
    void move();
    void rest(std::int64_t ticks);
    bool isResting() const { return m_resting; } ///< the next step would change nothing but temperatures
    bool isWatched() const { return bool(m_watch); }
    void watch(std::int64_t milliseconds) { m_watch ? m_watch(milliseconds) : void(); }
    /// @}

private:
    void wake() { m_resting = false; }
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
    double boundedDuty() const;
    double duty() const { return direction() * m_pwm / m_settings.fullPwm; }
    double pulsesPerRadian() const { return m_settings.resolution * 0.15915494309189535; }
    const JointTuning &tuning() const;

    JointSettings m_settings;
    const JointTuning *m_tuning = nullptr;
    Plant m_plant;
    Warmth m_warmth;
    Controller m_controller;
    PositionProfile m_profile;
    VelocityRamp m_ramp;
    Supply m_own;
    Supply *m_shared = nullptr;
    std::function<void(std::int64_t)> m_watch;
    std::uint64_t m_seed;
    std::int64_t m_tick = 0;   ///< ms on the bus's clock; what comes in between two of them acts from the later on
    std::int64_t m_origin = 0; ///< where the clock stood at first
    std::int64_t m_start = 0;  ///< of the profile or ramp
    double m_velocity = 0, m_pwm = 0; ///< pulses/ms, the estimate, in the shaft's direction; raw, as the register
    double m_volts = 12, m_restVolts = 12;
    double m_copperHeat = 0, m_bodyHeat = 0; ///< W × ms since the temperatures were last reckoned
    int m_heatTicks = 0, m_overloadTicks = 0;
    bool m_torque = false, m_stopped = false, m_powered = true;
    bool m_changing = true, m_resting = false; ///< this step isn't like the one before; is like all to come
};

} // namespace dynascope::sim
