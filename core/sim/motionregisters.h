// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/joint.h"
#include "core/sim/registerfile.h"

namespace dynascope::sim {

/// Between a servo's registers and its joint: settings and goals one way, the Present registers the other, and the
/// rules of Present Position (Homing Offset, one turn or many). Owned by the servo, whose registers it works on.
class MotionRegisters
{
public:
    MotionRegisters(RegisterFile &registers, const MotorModel &motor, std::uint64_t seed);

    Joint &joint() { return m_joint; }
    const Joint &joint() const { return m_joint; }

    void beginAt(LineTime now) { m_origin = now; }
    void advanceTo(LineTime now);
    void configure();            ///< settings and limits from the registers
    void setTorque(bool on);     ///< Torque Enable has become `on`
    void takeGoalPosition();     ///< Goal Position was written under torque
    void takeGoalVelocity();
    void holdStill();            ///< Bus Watchdog
    void bringIntoOneTurn();     ///< forget whole turns; where that happens: manual, "Present Position"
    void changeMode();           ///< what a write to Operating Mode puts back
    void publish();              ///< Present registers, Moving, trajectories: as of the last advanceTo()
    std::int32_t presentPosition() const;

private:
    std::int32_t homingOffset() const;
    std::int32_t toPresent(std::int32_t ofJoint) const { return ofJoint - m_turns + homingOffset(); }
    std::int32_t toJoint(std::int32_t present) const { return present - homingOffset() + m_turns; }

    RegisterFile &m_registers;
    Joint m_joint;
    LineTime m_origin{};      ///< the joint's time 0
    std::int32_t m_turns = 0; ///< pulses of the whole turns forgotten
};

} // namespace dynascope::sim
