// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/parser.h"
#include "core/sim/eepromwrites.h"
#include "core/sim/hardwareerrors.h"
#include "core/sim/motionregisters.h"
#include "core/sim/reaction.h"
#include "core/sim/servosettings.h"

#include <functional>

namespace dynascope::sim {

/// One virtual servo: its control table, and what it does with instructions. Hears bytes, says what it would answer;
/// knows no wire. Owned by the bus, on the bus's thread.
class Servo
{
public:
    using Identity = ServoIdentity;
    Servo(ControlTablePtr table, const MotorModel &motor, const Identity &identity, std::uint64_t seed);
    const QString &model() const { return m_registers.table().model(); }
    const ControlTable &table() const { return m_registers.table(); }
    int firmware() const { return static_cast<int>(m_registers.get(Reg::FirmwareVersion)); }
    int id() const { return static_cast<int>(m_registers.get(Reg::Id)); }
    int baudRate() const { return m_baudRate; }
    bool hasAlert() const { return m_errors.isAlert(); }
    bool isDeaf(LineTime now) const { return now < m_deafUntil; }
    bool isPowered() const { return m_powered; }
    ServoSettings &settings() { return m_settings; }
    Joint &joint() { return m_motion.joint(); } ///< load, supply, starting position
    LineTime now() const { return m_now; }
    void beginAt(LineTime now);   ///< what lies before was nothing; once, before anything else
    void advanceTo(LineTime now); ///< motion, watchdog, faults; never goes back
    /// Bytes, the first bit at `begin`. Appends what it would answer; true where an instruction packet was among them.
    bool hear(ByteView bytes, LineTime begin, LineTime byteTime, std::vector<Reaction> &reactions);

    /// @name Past the wire: for scripts and tests
    /// @{
    std::int64_t value(QStringView name); ///< as of the last advanceTo(); 0 where there is none
    std::int64_t value(const Field &field);
    DeviceError write(QStringView name, std::int64_t value); ///< with all checks and effects of a Write, stored at once
    bool inject(HardwareFault fault);         ///< as if it had happened; false where the model doesn't know it
    void setHardwareError(std::uint8_t bits); ///< the same, by the bits of Hardware Error Status
    void powerCycle();                        ///< deaf while it boots
    void setPower(bool on);                   ///< its own switch
    void setPlugged(bool plugged);            ///< without its cable: no power, nobody hears
    void followSupply();                      ///< the supply was turned on or off
    void setOtherAxis(const Servo *other) { m_otherAxis = other; } ///< of a two-axis model: one lock of the EEPROM
    const HardwareErrors &errors() const { return m_errors; }
    bool isShutDown() const { return m_shutDown; } ///< by Shutdown; the LED blinks
    /// @}

    using WriteObserver = std::function<void(Servo &, int address, ByteView data)>; ///< obeyed, and by the wire
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
    Outcome clearError();
    void storeEverything();
    Outcome readOut(int address, int length);
    Outcome takeWrite(const WriteCommand &command, Address how);
    Outcome actOnRegistered();
    void complain(const Parser::Damaged &damaged, LineTime heardAt, std::vector<Reaction> &reactions);
    Address addressed(std::uint8_t id) const;
    bool answers(Instruction instruction) const;
    bool supports(const Command &command) const;
    LineTime returnDelay() const;

    // servowrites.cpp
    struct Before;
    DeviceError checkWrite(int address, ByteView data, Address how) const;
    std::vector<const Field *> eepromIn(int address, ByteView data) const;
    void applyWrite(int address, ByteView data);
    void afterWrite(const std::vector<const Field *> &fields, const Before &before);
    void saveHybrid();
    void afterGoal(Reg goal);
    void setTorque(bool on);
    // servo.cpp, servopower.cpp
    void watch(LineTime at);
    void watchBus(LineTime at);
    void watchFaults(const JointState &state);
    void shutDown();
    void boot(LineTime at);
    void updatePower(LineTime at);
    void losePower(LineTime at);
    void refresh(); ///< live registers

    RegisterFile m_registers;
    MotionRegisters m_motion;
    HardwareErrors m_errors;
    EepromWrites m_eeprom;
    ServoSettings m_settings;
    Parser m_parser;
    int m_baudRate;
    LineTime m_bootSpread; ///< its Realtime Tick begins so much later than it hears
    LineTime m_now{}, m_heardLast{}, m_instructedLast{}, m_deafUntil{}, m_bootedAt{};
    bool m_shutDown = false, m_restart = false; ///< no torque until it boots; boots as soon as the answer is made
    bool m_torqueAtBoot = false, m_powered = true, m_plugged = true, m_switchedOn = true, m_brownOut = false;
    const Servo *m_otherAxis = nullptr;
    std::optional<WriteCommand> m_registered;
    std::optional<Bytes> m_backup;
    WriteObserver m_observer;
};

} // namespace dynascope::sim
