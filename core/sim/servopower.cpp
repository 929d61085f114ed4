// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

namespace dynascope::sim {
namespace {

constexpr int TorqueOnAtStartup = 1, RamFromBackup = 2; ///< bits of Startup Configuration

} // namespace

void Servo::setPlugged(bool plugged)
{
    m_plugged = plugged;
    updatePower(m_now);
}

void Servo::setPower(bool on)
{
    m_switchedOn = on;
    updatePower(m_now);
}

void Servo::followSupply()
{
    m_brownOut = false; // the watch finds out
    updatePower(m_now);
}

void Servo::updatePower(LineTime at)
{
    const bool powered = m_plugged && m_switchedOn && !m_brownOut && m_motion.joint().supply().isOn();
    if (powered == m_powered)
        return;
    if (!powered)
        return losePower(at);
    m_powered = true;
    m_motion.joint().setPowered(true);
    boot(at);
}

void Servo::losePower(LineTime at)
{
    m_powered = false;
    m_deafUntil = LineTime::max();
    m_torqueAtBoot = m_shutDown = false;
    m_registered.reset();
    m_parser.reset();
    m_eeprom.cut(m_registers, at);
    m_registers.losePower();
    m_motion.joint().setPowered(false);
    m_motion.configure();
}

void Servo::powerCycle()
{
    if (!m_powered)
        return;
    losePower(m_now);
    updatePower(m_now);
}

void Servo::boot(LineTime at)
{
    m_restart = false;
    m_deafUntil = at + m_settings.bootTime;
    m_bootedAt = m_deafUntil + m_bootSpread;
    m_instructedLast = m_deafUntil;
    m_shutDown = false;
    m_registered.reset();
    m_parser.reset();
    m_registers.resetRam();
    m_baudRate = table().baudRate(static_cast<int>(m_registers.get(Reg::BaudRate))).value_or(m_baudRate);
    const std::int64_t startup = m_registers.get(Reg::StartupConfiguration);
    if ((startup & RamFromBackup) && m_backup) {
        for (const Field &field : table().fields()) {
            if (field.area == Area::Ram && field.isWritable() && &field != m_registers.field(Reg::TorqueEnable))
                m_registers.set(field, rawFromBytes(field, ByteView(*m_backup).subspan(field.address, field.size)));
        }
    }
    m_motion.setTorque(false);
    m_motion.configure();
    m_motion.bringIntoOneTurn();
    m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    m_torqueAtBoot = (startup & TorqueOnAtStartup) != 0;
}

} // namespace dynascope::sim
