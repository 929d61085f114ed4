// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dynascope::sim {

class Joint;

/// What feeds the servos on one pair of wires: a voltage behind a resistance, so that it sags under the current of all
/// of them, and rises when they brake. Keeps their clock: joints that share a supply move together, in steps of 1 ms.
class Supply
{
public:
    /// Ω of wires and supply. Chosen: two metres of the usual cable and a small supply.
    static constexpr double UsualResistance = 0.1;

    explicit Supply(double volts = 12, double ohms = UsualResistance);

    void setVoltage(double volts);   ///< without load
    void setResistance(double ohms);
    void setOn(bool on) { m_on = on; }
    double voltage() const { return m_volts; }
    double resistance() const { return m_ohms; }
    bool isOn() const { return m_on; }
    double terminalVoltage() const { return m_terminal; } ///< V, what the servos see, as of the last step
    double current() const { return m_current; }          ///< A, of all of them

    /// @name What joints use
    /// @{
    void beginAt(std::int64_t milliseconds) { m_tick = milliseconds; }
    void advance(std::span<Joint *const> joints, std::int64_t milliseconds);
    /// @}

    /// Joints that share it; they outlive it or are taken out.
    void add(Joint &joint);
    void remove(Joint &joint);
    const std::vector<Joint *> &joints() const { return m_joints; }

private:
    void step(std::span<Joint *const> joints);
    void settle(std::span<Joint *const> joints);

    double m_volts = 12, m_ohms = UsualResistance, m_terminal = 12, m_current = 0;
    bool m_on = true;
    std::int64_t m_tick = 0; ///< ms
    std::vector<Joint *> m_joints;
};

} // namespace dynascope::sim
