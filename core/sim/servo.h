// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/parser.h"
#include "core/protocol/requests.h"
#include "core/sim/motionregisters.h"
#include "core/sim/servosettings.h"

#include <functional>

namespace dynascope::sim {

/// What a servo wants to say to an instruction packet; when, the bus knows.
struct Reaction {
    enum class Turn {
        Direct, ///< `delay` after the packet
        Slot,   ///< in the order of IDs: broadcast Ping
        Chain,  ///< after the device listed before it: group reads
    };
    Turn turn = Turn::Direct;
    LineTime heardAt{}; ///< the packet's last bit
    LineTime delay{};   ///< processing and Return Delay Time
    int baudRate = 57600;
    StatusPacket status;
    GroupReadCommand group{}; ///< with Chain
    std::size_t index = 0;    ///< with Chain: our place in group.spans
};

/// One virtual servo: its control table, and what it does with instructions. Hears bytes, says what it would answer;
/// knows no wire. Owned by the bus, on the bus's thread.
class Servo
{
public:
    struct Identity {
        int firmware = 0;
        int id = 1;
        int baudRate = 57600;
    };
    Servo(ControlTablePtr table, const MotorModel &motor, const Identity &identity, std::uint64_t seed);
    const QString &model() const { return m_registers.table().model(); }
    const ControlTable &table() const { return m_registers.table(); }
    int firmware() const { return static_cast<int>(m_registers.get(Reg::FirmwareVersion)); }
    int id() const { return static_cast<int>(m_registers.get(Reg::Id)); }
    int baudRate() const { return m_baudRate; }
    bool hasAlert() const { return m_registers.get(Reg::HardwareErrorStatus) != 0; }
    bool isDeaf(LineTime now) const { return now < m_deafUntil; }
    ServoSettings &settings() { return m_settings; }
    Joint &joint() { return m_motion.joint(); } ///< load, supply, starting position

    void beginAt(LineTime now);   ///< what lies before was nothing; once, before anything else
    void advanceTo(LineTime now); ///< motion, watchdog, faults; never goes back

    /// Bytes, the first bit at `begin`. Appends what it would answer; true where an instruction packet was among them.
    bool hear(ByteView bytes, LineTime begin, LineTime byteTime, std::vector<Reaction> &reactions);

    /// @name Past the wire: for scripts and tests
    /// @{
    std::int64_t value(QStringView name);                    ///< as of the last advanceTo(); 0 where there is none
    DeviceError write(QStringView name, std::int64_t value); ///< with all checks and effects of a Write
    void setHardwareError(std::uint8_t bits);                ///< as if it had happened: Alert, Shutdown
    void powerCycle() { boot(m_now); }                       ///< deaf while it boots
    void setPlugged(bool plugged);                           ///< without its cable: no power, nobody hears
    void setOtherAxis(const Servo *other) { m_otherAxis = other; } ///< of a two-axis model: one lock of the EEPROM
    /// @}
    /// After each write that came by the wire and was obeyed.
    using WriteObserver = std::function<void(Servo &, int address, ByteView data)>;
    void setWriteObserver(WriteObserver observer) { m_observer = std::move(observer); }

private:
    struct Outcome {
        DeviceError error = DeviceError::None;
        Bytes data;
        LineTime extra{}; ///< longer than ordinary processing
        bool silent = false;
    };
    enum class Address { Other, Own, Secondary, Everyone };

    // servocommands.cpp
    void obey(const InstructionPacket &packet, LineTime heardAt, std::vector<Reaction> &reactions);
    void obeyGroup(const GroupReadCommand &command, LineTime heardAt, std::vector<Reaction> &reactions);
    Outcome carryOut(const Command &command, Address how);
    Outcome carryOut(const FactoryResetCommand &command, Address how);
    Outcome carryOut(const ClearCommand &command);
    Outcome carryOut(const BackupCommand &command);
    Outcome readOut(int address, int length);
    Outcome takeWrite(const WriteCommand &command, Address how);
    Outcome actOnRegistered();
    void complain(const Parser::Damaged &damaged, LineTime heardAt, std::vector<Reaction> &reactions);
    Address addressed(std::uint8_t id) const;
    bool answers(Instruction instruction) const;
    bool supports(const Command &command) const;
    LineTime returnDelay() const;

    // servowrites.cpp
    DeviceError checkWrite(int address, ByteView data, Address how) const;
    bool touchesEeprom(int address, ByteView data) const;
    void applyWrite(int address, ByteView data);
    void afterWrite(const std::vector<const Field *> &fields, bool torqueBefore);
    void afterGoal(Reg goal);
    void setTorque(bool on);

    // servo.cpp
    void boot(LineTime at);
    void watch();
    void refresh(); ///< live registers

    RegisterFile m_registers;
    MotionRegisters m_motion;
    ServoSettings m_settings;
    Parser m_parser;
    int m_baudRate;
    LineTime m_now{}, m_heardLast{}, m_instructedLast{}, m_deafUntil{}, m_bootedAt{};
    bool m_shutDown = false, m_restart = false; ///< no torque until it boots; boots as soon as the answer is made
    const Servo *m_otherAxis = nullptr;
    std::optional<WriteCommand> m_registered;
    std::optional<Bytes> m_backup;
    WriteObserver m_observer;
};

} // namespace dynascope::sim
