// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dynascope::sim {

/// What the profile generator wants at one moment: pulses, pulses/ms, pulses/ms².
struct TrajectoryPoint {
    double position = 0, velocity = 0, acceleration = 0;

    friend bool operator==(const TrajectoryPoint &, const TrajectoryPoint &) = default;
};

/// As Moving Status bits 4-5 count them.
enum class ProfileShape { Step = 0, Rectangle = 1, Triangle = 2, Trapezoid = 3 };

/// Profile Velocity and Profile Acceleration, in the generator's units.
struct ProfileLimits {
    bool timeBased = false;  ///< Drive Mode bit 2
    double velocity = 0;     ///< pulses/ms; 0: unlimited. Time-based: ms for the whole
    double acceleration = 0; ///< pulses/ms²; 0: at once. Time-based: ms for each ramp, at most half of the whole
};

/// The way from a trajectory's present state to a goal: ramp, cruise, ramp to standstill; a value. With an acceleration
/// the velocity is continuous, so the generator may start out of any motion. Manual: "Profile".
class PositionProfile
{
public:
    PositionProfile() = default; ///< stands at 0
    explicit PositionProfile(double position); ///< stands there
    PositionProfile(const TrajectoryPoint &from, double goal, const ProfileLimits &limits);

    void shift(double pulses) { m_start += pulses, m_goal += pulses; }
    TrajectoryPoint at(double milliseconds) const; ///< since the start; stands at the goal after the end
    double duration() const { return m_ramp + m_cruise + m_brake; } ///< ms
    double goal() const { return m_goal; }
    ProfileShape shape() const { return m_shape; }

private:
    void plan(double distance, const ProfileLimits &limits);
    void planTimed(double distance, const ProfileLimits &limits);

    double m_start = 0, m_startVelocity = 0, m_goal = 0;
    double m_cruiseVelocity = 0;
    double m_ramp = 0, m_cruise = 0, m_brake = 0; ///< ms
    ProfileShape m_shape = ProfileShape::Step;
};

/// Velocity mode: from the present velocity to the goal, by Profile Acceleration alone.
class VelocityRamp
{
public:
    VelocityRamp() = default; ///< stands still
    VelocityRamp(double from, double goal, const ProfileLimits &limits); ///< pulses/ms

    double at(double milliseconds) const;
    double duration() const { return m_duration; } ///< ms
    double goal() const { return m_goal; }

private:
    double m_from = 0, m_goal = 0, m_duration = 0;
};

} // namespace dynascope::sim
