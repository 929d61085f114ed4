// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

constexpr std::array Goals{Reg::GoalPwm, Reg::GoalCurrent, Reg::GoalVelocity, Reg::GoalPosition};
constexpr int ReverseBit = 0, TorqueOnByGoalBit = 3; ///< of Drive Mode
constexpr std::int64_t SaveHybrid = 1, HybridSaved = 2;

bool hasBit(const Field &field, int number)
{
    return field.bits.empty()
           || std::ranges::any_of(field.bits, [number](const BitField &bit) { return bit.first == number; });
}

} // namespace

/// What a write is judged against.
struct Servo::Before {
    bool torque = false;
    std::int64_t operatingMode = 0, driveMode = 0;
};

std::vector<const Field *> Servo::eepromIn(int address, ByteView data) const
{
    std::vector<const Field *> found;
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        for (const Field *field : m_registers.fieldsIn(run)) {
            if (field->area == Area::Eeprom)
                found.push_back(field);
        }
    }
    return found;
}

DeviceError Servo::checkWrite(int address, ByteView data, Address how) const
{
    if (data.empty())
        return DeviceError::DataLength;
    if (!m_registers.isInside(address, static_cast<int>(data.size())))
        return DeviceError::Access;
    const bool torque = m_motion.joint().torque() || (m_otherAxis && m_otherAxis->m_motion.joint().torque());
    if ((torque || how == Address::Secondary) && !eepromIn(address, data).empty())
        return DeviceError::Access;
    const RegisterFile::Refusals refusals{m_settings.limitError, m_settings.alignmentError};
    const bool watchdogTripped = m_registers.get(Reg::BusWatchdog) < 0;
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        const DeviceError error = m_registers.check(run, refusals);
        if (error != DeviceError::None)
            return error;
        for (const Field *field : m_registers.fieldsIn(run)) {
            const auto isIt = [&](Reg goal) { return m_registers.field(goal) == field; };
            if (torque && field->torqueOff)
                return DeviceError::Access;
            if (watchdogTripped && std::ranges::any_of(Goals, isIt))
                return DeviceError::DataRange;
            // Only 0 ends it.
            const std::size_t at = static_cast<std::size_t>(std::max(0, field->address - run.address));
            if (watchdogTripped && isIt(Reg::BusWatchdog)
                && rawFromBytes(*field, ByteView(run.data).subspan(at, field->size)) != 0)
                return DeviceError::DataRange;
        }
    }
    return DeviceError::None;
}

void Servo::applyWrite(int address, ByteView data)
{
    const Before before{m_motion.joint().torque(), m_registers.get(Reg::OperatingMode),
                        m_registers.get(Reg::DriveMode)};
    std::vector<const Field *> fields;
    for (const RegisterFile::Run &run : m_registers.targets(address, data)) {
        m_registers.store(run);
        std::ranges::copy(m_registers.fieldsIn(run), std::back_inserter(fields));
    }
    afterWrite(fields, before);
}

void Servo::afterWrite(const std::vector<const Field *> &fields, const Before &before)
{
    const auto written = [&](Reg reg) {
        const Field *field = m_registers.field(reg);
        return field && std::ranges::find(fields, field) != fields.end();
    };
    const bool turnedRound = ((m_registers.get(Reg::DriveMode) ^ before.driveMode) >> ReverseBit) & 1;
    if (written(Reg::BaudRate))
        m_baudRate = table().baudRate(static_cast<int>(m_registers.get(Reg::BaudRate))).value_or(m_baudRate);
    if (m_registers.get(Reg::OperatingMode) != before.operatingMode)
        m_motion.changeMode();
    m_motion.configure();
    if (turnedRound)
        m_motion.bringIntoOneTurn();
    if (written(Reg::HomingOffset) || turnedRound)
        m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    if (written(Reg::BusWatchdog))
        m_motion.joint().endStop();
    if (written(Reg::HybridSave) && m_registers.get(Reg::HybridSave) == SaveHybrid)
        saveHybrid();
    const bool torqueAsked = m_registers.get(Reg::TorqueEnable) != 0;
    if (written(Reg::TorqueEnable) && torqueAsked != before.torque)
        setTorque(torqueAsked);
    for (const Reg goal : Goals) {
        if (written(goal))
            afterGoal(goal);
    }
}

/// Manual: "Hybrid Save" of the Y series.
void Servo::saveHybrid()
{
    std::vector<const Field *> hybrid;
    for (const Field &field : table().fields()) {
        if (field.area == Area::Hybrid)
            hybrid.push_back(&field);
    }
    m_eeprom.begin(m_registers, hybrid, m_now, m_settings.eepromWrite);
    m_registers.set(Reg::HybridSave, HybridSaved);
}

void Servo::afterGoal(Reg goal)
{
    if (!m_motion.joint().torque()) {
        const Field *mode = m_registers.field(Reg::DriveMode);
        if (!mode || !hasBit(*mode, TorqueOnByGoalBit)
            || ((m_registers.get(*mode) >> TorqueOnByGoalBit) & 1) == 0)
            return;
        const std::int64_t wanted = m_registers.get(goal);
        setTorque(true);
        if (!m_motion.joint().torque())
            return;
        m_registers.set(goal, wanted); // the one case where the goal doesn't become the present position
        m_motion.configure();
    }
    const bool velocityMode = m_motion.operatingMode() == VelocityMode;
    if (goal == Reg::GoalPosition && !velocityMode)
        m_motion.takeGoalPosition();
    else if (goal == Reg::GoalVelocity && velocityMode)
        m_motion.takeGoalVelocity();
}

void Servo::setTorque(bool on)
{
    m_torqueAtBoot = false;
    if (on && (m_shutDown || !m_powered))
        on = false; // stays off until a reboot; manual: "Shutdown"
    m_registers.set(Reg::TorqueEnable, on ? 1 : 0);
    if (on) {
        if (m_motion.operatingMode() == PositionMode)
            m_motion.bringIntoOneTurn();
        if (m_settings.goalOnTorqueOn == ServoSettings::GoalOnTorqueOn::BecomesPresentPosition)
            m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    }
    m_motion.setTorque(on);
}

} // namespace dynascope::sim
