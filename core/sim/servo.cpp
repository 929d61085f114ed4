// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

using namespace std::chrono_literals;

constexpr LineTime LongestGap = 1500us; ///< inside a packet; manual: "communication overview"
constexpr LineTime WatchdogUnit = 20ms;
constexpr std::int64_t WatchdogTripped = -1;
constexpr std::int64_t UsualTickPeriod = 32768;

/// No two servos come up in the same moment; their Realtime Ticks differ.
LineTime bootSpread(std::uint64_t seed)
{
    constexpr std::uint64_t Most = 40'000; // µs; chosen
    std::uint64_t x = (seed ^ (seed >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return std::chrono::microseconds((x ^ (x >> 31)) % Most);
}

} // namespace

Servo::Servo(ControlTablePtr table, const MotorModel &motor, const Identity &identity, std::uint64_t seed)
    : m_registers(std::move(table))
    , m_motion(m_registers, motor, seed)
    , m_errors(m_registers)
    , m_baudRate(identity.baudRate)
    , m_bootSpread(bootSpread(seed))
{
    m_registers.set(Reg::FirmwareVersion, identity.firmware);
    m_registers.set(Reg::Id, identity.id);
    m_registers.set(Reg::BaudRate, this->table().baudCode(identity.baudRate).value_or(0));
    m_registers.keepAll();
    m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    m_motion.joint().useTuning(&m_settings.control);
    m_motion.joint().setWatch([this](std::int64_t at) { watch(std::chrono::milliseconds(at)); });
}

void Servo::beginAt(LineTime now)
{
    m_now = m_heardLast = m_instructedLast = m_deafUntil = now;
    m_bootedAt = now + m_bootSpread;
    m_motion.beginAt(now);
}

void Servo::advanceTo(LineTime now)
{
    m_motion.advanceTo(now);
    m_now = std::max(m_now, now);
    if (m_torqueAtBoot && m_now >= m_deafUntil)
        setTorque(true);
}

/// Every 10 ms of the joint's clock.
void Servo::watch(LineTime at)
{
    m_now = std::max(m_now, at);
    const JointState state = m_motion.joint().state();
    if (const Field *lowest = m_registers.field(Reg::MinVoltageLimit)) {
        const double needed = static_cast<double>(m_registers.initial(Reg::MinVoltageLimit)) * lowest->scale;
        m_brownOut = m_motion.joint().supply().isOn() && state.inputVoltage < m_settings.brownOut * needed;
    }
    updatePower(at);
    if (!m_powered)
        return;
    watchBus(at);
    watchFaults(state);
    if (m_torqueAtBoot && m_now >= m_deafUntil)
        setTorque(true);
}

void Servo::watchFaults(const JointState &state)
{
    const auto raise = [this](HardwareFault fault) {
        if (m_errors.latch(fault))
            shutDown();
    };
    const auto beyond = [this](Reg reg, double value, double sign) {
        const Field *field = m_registers.field(reg);
        return field && sign * value > sign * static_cast<double>(m_registers.get(*field)) * field->scale;
    };
    if (beyond(Reg::MaxVoltageLimit, state.inputVoltage, 1) || beyond(Reg::MinVoltageLimit, state.inputVoltage, -1))
        raise(HardwareFault::InputVoltage);
    if (beyond(Reg::TemperatureLimit, state.temperature, 1))
        raise(HardwareFault::Overheating);
    if (state.overload)
        raise(HardwareFault::Overload);
}

void Servo::watchBus(LineTime at)
{
    const std::int64_t units = m_registers.get(Reg::BusWatchdog);
    if (!m_motion.joint().torque() || units <= 0 || at - m_instructedLast <= units * WatchdogUnit)
        return;
    m_registers.set(Reg::BusWatchdog, WatchdogTripped);
    m_registers.set(Reg::ProfileVelocity, 0);
    m_registers.set(Reg::ProfileAcceleration, 0);
    m_motion.configure();
    m_motion.holdStill();
}

bool Servo::inject(HardwareFault fault)
{
    if (!m_errors.knows(fault))
        return false;
    if (m_errors.latch(fault))
        shutDown();
    return true;
}

void Servo::setHardwareError(std::uint8_t bits)
{
    if (m_errors.latchBits(bits))
        shutDown();
}

void Servo::shutDown()
{
    if (m_shutDown)
        return;
    m_shutDown = true;
    setTorque(false);
}

void Servo::refresh()
{
    m_motion.publish();
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(std::max(m_now - m_bootedAt, LineTime{}));
    const Field *tick = m_registers.field(Reg::RealtimeTick);
    const std::int64_t period = tick ? tick->maximum.number.value_or(UsualTickPeriod - 1) + 1 : UsualTickPeriod;
    m_registers.set(Reg::RealtimeTick, since.count() % std::max<std::int64_t>(1, period));
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
    const Field *field = table().find(name);
    return field ? value(*field) : 0;
}

std::int64_t Servo::value(const Field &field)
{
    refresh();
    return m_registers.get(field);
}

DeviceError Servo::write(QStringView name, std::int64_t value)
{
    const Field *field = table().find(name);
    if (!field)
        return DeviceError::Access;
    const Bytes data = bytesFromRaw(*field, value);
    const DeviceError error = checkWrite(field->address, data, Address::Own);
    if (error != DeviceError::None)
        return error;
    applyWrite(field->address, data);
    m_eeprom.begin(m_registers, eepromIn(field->address, data), m_now, {});
    return error;
}

} // namespace dynascope::sim
