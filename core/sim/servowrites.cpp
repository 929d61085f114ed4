// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

constexpr std::array Goals{Reg::GoalPwm, Reg::GoalCurrent, Reg::GoalVelocity, Reg::GoalPosition};
constexpr std::int64_t TorqueOnByGoal = 8; ///< bit 3 of Drive Mode
constexpr std::int64_t PositionMode = 3, VelocityMode = 1;

} // namespace

bool Servo::touchesEeprom(int address, ByteView data) const
{
    const auto isEeprom = [](const Field *field) { return field->area == Area::Eeprom; };
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        if (std::ranges::any_of(m_registers.fieldsIn(run), isEeprom))
            return true;
    }
    return false;
}

DeviceError Servo::checkWrite(int address, ByteView data, Address how) const
{
    if (data.empty())
        return DeviceError::DataLength;
    if (!m_registers.isInside(address, static_cast<int>(data.size())))
        return DeviceError::Access;
    const bool locked = m_motion.joint().torque() || (m_otherAxis && m_otherAxis->m_motion.joint().torque());
    if (touchesEeprom(address, data) && (locked || how == Address::Secondary))
        return DeviceError::Access;
    const bool watchdogTripped = m_registers.get(Reg::BusWatchdog) < 0;
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        const DeviceError error = m_registers.check(run, m_settings.limitError);
        if (error != DeviceError::None)
            return error;
        for (const Field *field : m_registers.fieldsIn(run)) {
            const auto isIt = [&](Reg goal) { return m_registers.field(goal) == field; };
            if (watchdogTripped && std::ranges::any_of(Goals, isIt))
                return DeviceError::DataRange;
        }
    }
    return DeviceError::None;
}

void Servo::applyWrite(int address, ByteView data)
{
    const bool torqueBefore = m_motion.joint().torque();
    std::vector<const Field *> fields;
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        m_registers.store(run);
        std::ranges::copy(m_registers.fieldsIn(run), std::back_inserter(fields));
    }
    afterWrite(fields, torqueBefore);
}

void Servo::afterWrite(const std::vector<const Field *> &fields, bool torqueBefore)
{
    const auto written = [&](Reg reg) {
        const Field *field = m_registers.field(reg);
        return field && std::ranges::find(fields, field) != fields.end();
    };
    if (written(Reg::BaudRate))
        m_baudRate = table().baudRate(static_cast<int>(m_registers.get(Reg::BaudRate))).value_or(m_baudRate);
    if (written(Reg::OperatingMode))
        m_motion.changeMode();
    m_motion.configure();
    if (written(Reg::DriveMode))
        m_motion.bringIntoOneTurn();
    if (written(Reg::HomingOffset) || written(Reg::DriveMode))
        m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    if (written(Reg::BusWatchdog))
        m_motion.joint().endStop();
    const bool torqueAsked = m_registers.get(Reg::TorqueEnable) != 0;
    if (written(Reg::TorqueEnable) && torqueAsked != torqueBefore)
        setTorque(torqueAsked);
    for (const Reg goal : Goals) {
        if (written(goal))
            afterGoal(goal);
    }
}

void Servo::afterGoal(Reg goal)
{
    if (!m_motion.joint().torque()) {
        if ((m_registers.get(Reg::DriveMode) & TorqueOnByGoal) == 0)
            return;
        const std::int64_t wanted = m_registers.get(goal);
        setTorque(true);
        if (!m_motion.joint().torque())
            return;
        m_registers.set(goal, wanted); // the one case where the goal doesn't become the present position
        m_motion.configure();
    }
    const bool velocityMode = m_registers.get(Reg::OperatingMode) == VelocityMode;
    if (goal == Reg::GoalPosition && !velocityMode)
        m_motion.takeGoalPosition();
    else if (goal == Reg::GoalVelocity && velocityMode)
        m_motion.takeGoalVelocity();
}

void Servo::setTorque(bool on)
{
    if (on && m_shutDown)
        on = false; // stays off until a reboot; manual: "Shutdown"
    m_registers.set(Reg::TorqueEnable, on ? 1 : 0);
    if (on) {
        if (m_registers.get(Reg::OperatingMode) == PositionMode)
            m_motion.bringIntoOneTurn();
        if (m_settings.goalOnTorqueOn == ServoSettings::GoalOnTorqueOn::BecomesPresentPosition)
            m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    }
    m_motion.setTorque(on);
}

} // namespace dynascope::sim
