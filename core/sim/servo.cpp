// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

using namespace std::chrono_literals;

constexpr LineTime LongestGap = 1500us; ///< inside a packet; manual: "communication overview"
constexpr LineTime WatchdogUnit = 20ms;
constexpr LineTime LongestStep = 20ms;  ///< how late a fault may be noticed
constexpr std::int64_t WatchdogTripped = -1;
constexpr std::int64_t TickPeriod = 32768;
constexpr int TorqueOnAtStartup = 1, RamFromBackup = 2; ///< bits of Startup Configuration

/// No two servos come up in the same moment; their Realtime Ticks differ.
LineTime bootSpread(std::uint64_t seed)
{
    constexpr std::uint64_t Most = 40'000; // µs; chosen
    std::uint64_t x = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return std::chrono::microseconds((x ^ (x >> 31)) % Most);
}

enum HardwareError { InputVoltage = 0x01, Overheating = 0x04, Overload = 0x20 };

} // namespace

Servo::Servo(ControlTablePtr table, const MotorModel &motor, const Identity &identity, std::uint64_t seed)
    : m_registers(std::move(table))
    , m_motion(m_registers, motor, seed)
    , m_baudRate(identity.baudRate)
    , m_bootSpread(bootSpread(seed))
{
    m_registers.set(Reg::FirmwareVersion, identity.firmware);
    m_registers.set(Reg::Id, identity.id);
    m_registers.set(Reg::BaudRate, this->table().baudCode(identity.baudRate).value_or(0));
    m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
}

void Servo::beginAt(LineTime now)
{
    m_now = m_heardLast = m_instructedLast = m_deafUntil = now;
    m_bootedAt = now + m_bootSpread;
    m_motion.beginAt(now);
}

void Servo::advanceTo(LineTime now)
{
    while (m_now < now) {
        m_now = std::min(now, m_now + LongestStep);
        m_motion.advanceTo(m_now);
        watch();
    }
}

void Servo::watch()
{
    const std::int64_t units = m_registers.get(Reg::BusWatchdog);
    const bool torque = m_motion.joint().torque();
    if (torque && units > 0 && m_now - m_instructedLast > units * WatchdogUnit) {
        m_registers.set(Reg::BusWatchdog, WatchdogTripped);
        m_registers.set(Reg::ProfileVelocity, 0);
        m_registers.set(Reg::ProfileAcceleration, 0);
        m_motion.configure();
        m_motion.holdStill();
    }
    const JointState state = m_motion.joint().state();
    int found = 0;
    if (m_registers.has(Reg::MaxVoltageLimit)
        && (state.inputVoltage > m_registers.get(Reg::MaxVoltageLimit)
            || state.inputVoltage < m_registers.get(Reg::MinVoltageLimit)))
        found |= InputVoltage;
    if (m_registers.has(Reg::TemperatureLimit) && state.temperature > m_registers.get(Reg::TemperatureLimit))
        found |= Overheating;
    if (state.overload)
        found |= Overload;
    if (found)
        setHardwareError(static_cast<std::uint8_t>(found));
}

void Servo::setHardwareError(std::uint8_t bits)
{
    m_registers.set(Reg::HardwareErrorStatus, m_registers.get(Reg::HardwareErrorStatus) | bits);
    if ((m_registers.get(Reg::Shutdown) & bits) == 0 || m_shutDown)
        return;
    m_shutDown = true;
    setTorque(false);
}

void Servo::setPlugged(bool plugged)
{
    boot(m_now);
    if (!plugged)
        m_deafUntil = LineTime::max();
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
    if (startup & TorqueOnAtStartup)
        setTorque(true);
}

void Servo::refresh()
{
    m_motion.publish();
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(std::max(m_now - m_bootedAt, LineTime{}));
    m_registers.set(Reg::RealtimeTick, since.count() % TickPeriod);
    m_registers.set(Reg::RegisteredInstruction, m_registered ? 1 : 0);
}

bool Servo::hear(ByteView bytes, LineTime begin, LineTime byteTime, std::vector<Reaction> &reactions)
{
    if (isDeaf(begin)) {
        m_parser.reset();
        return false;
    }
    if (begin - m_heardLast > LongestGap)
        m_parser.reset();
    bool instructed = false;
    LineTime at = begin;
    for (const std::uint8_t &byte : bytes) {
        at += byteTime;
        m_parser.feed({&byte, 1});
        while (const auto event = m_parser.next()) {
            if (const auto *damaged = std::get_if<Parser::Damaged>(&*event))
                complain(*damaged, at, reactions);
            const auto *packet = std::get_if<Parser::Packet>(&*event);
            if (!packet || packet->isStatus())
                continue;
            instructed = true;
            obey(packet->request(), at, reactions);
            if (isDeaf(at))
                return true;
        }
    }
    m_heardLast = at;
    return instructed;
}

std::int64_t Servo::value(QStringView name)
{
    refresh();
    const Field *field = table().find(name);
    return field ? m_registers.get(*field) : 0;
}

DeviceError Servo::write(QStringView name, std::int64_t value)
{
    const Field *field = table().find(name);
    if (!field)
        return DeviceError::Access;
    const Bytes data = bytesFromRaw(*field, value);
    const DeviceError error = checkWrite(field->address, data, Address::Own);
    if (error == DeviceError::None)
        applyWrite(field->address, data);
    return error;
}

} // namespace dynascope::sim
