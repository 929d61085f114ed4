// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/joint.h"
#include "core/sim/registerfile.h"

namespace dynascope::sim {

constexpr int VelocityMode = 1, PositionMode = 3; ///< of Operating Mode

/// Between a servo's registers and its joint: settings and goals one way, the Present registers the other, and the
/// rules of Present Position (Homing Offset, one turn or many). Owned by the servo, whose registers it works on.
class MotionRegisters
{
public:
    MotionRegisters(RegisterFile &registers, const MotorModel &motor, std::uint64_t seed);

    Joint &joint() { return m_joint; }
    const Joint &joint() const { return m_joint; }

    void beginAt(LineTime now);
    void advanceTo(LineTime now);
    void configure();            ///< settings and limits from the registers
    void setTorque(bool on);     ///< Torque Enable has become `on`
    void takeGoalPosition();     ///< Goal Position was written under torque
    void takeGoalVelocity();
    void holdStill();            ///< Bus Watchdog
    void bringIntoOneTurn();     ///< forget whole turns; where that happens: manual, "Present Position"
    void changeMode();           ///< what a new Operating Mode puts back
    void publish();              ///< Present registers, Moving, trajectories: as of the last advanceTo()
    std::int32_t presentPosition() const;
    int operatingMode() const;   ///< as the X series counts them, also where the model calls it Control Mode

private:
    JointSettings gains() const;
    void setBounds(JointSettings &settings) const;
    void setProfile(JointSettings &settings) const;
    void setUnits(JointSettings &settings) const;
    double startAngle() const;
    std::int64_t homingOffset() const;
    // Past 32 bits they wrap round, as counters do.
    std::int32_t toPresent(std::int64_t ofJoint) const { return std::int32_t(ofJoint - m_turns + homingOffset()); }
    std::int32_t toJoint(std::int64_t present) const { return std::int32_t(present - homingOffset() + m_turns); }

    RegisterFile &m_registers;
    Joint m_joint;
    bool m_xGains;            ///< gains mean what the X series' manual says
    std::int64_t m_statusMask = 0xFF; ///< bits that Moving Status has
    std::int64_t m_turns = 0; ///< pulses of the whole turns forgotten
};

} // namespace dynascope::sim
