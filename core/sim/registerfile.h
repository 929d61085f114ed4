// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/protocol_values.h"
#include "core/table/controltable.h"

#include <array>

namespace dynascope::sim {

/// The registers whose meaning the simulator knows; names in registerfile.cpp.
enum class Reg {
    ModelNumber, FirmwareVersion, Id, BaudRate, ReturnDelayTime, DriveMode, OperatingMode, SecondaryId, ProtocolType,
    HomingOffset, MovingThreshold, TemperatureLimit, MaxVoltageLimit, MinVoltageLimit, PwmLimit, CurrentLimit,
    VelocityLimit, MaxPositionLimit, MinPositionLimit, StartupConfiguration, Shutdown, TorqueEnable, Led,
    StatusReturnLevel, RegisteredInstruction, HardwareErrorStatus, VelocityIGain, VelocityPGain, PositionDGain,
    PositionIGain, PositionPGain, Feedforward2ndGain, Feedforward1stGain, BusWatchdog, GoalPwm, GoalCurrent,
    GoalVelocity, ProfileAcceleration, ProfileVelocity, GoalPosition, RealtimeTick, Moving, MovingStatus, PresentPwm,
    PresentCurrent, PresentLoad, PresentVelocity, PresentPosition, VelocityTrajectory, PositionTrajectory,
    PresentInputVoltage, PresentTemperature, BackupReady,
    Count
};

/// One servo's control table as bytes, with the Indirect Data registers seen through. Knows what a register allows by
/// the table; what a write makes happen is the servo's.
class RegisterFile
{
public:
    explicit RegisterFile(ControlTablePtr table);

    const ControlTable &table() const { return *m_table; }
    bool has(Reg reg) const { return field(reg) != nullptr; }
    const Field *field(Reg reg) const { return m_known[static_cast<std::size_t>(reg)]; }
    std::int64_t get(Reg reg) const;           ///< 0 where the model has no such register
    void set(Reg reg, std::int64_t value);     ///< nothing where the model has no such register
    std::int64_t initial(Reg reg) const;       ///< factory value, 0 where the table states none
    std::int64_t get(const Field &field) const;
    void set(const Field &field, std::int64_t value);

    /// A stretch of bytes where they really stand, Indirect Data resolved.
    struct Run {
        int address = 0;
        Bytes data;
    };
    std::vector<Run> targets(int address, ByteView data) const;
    bool isInside(int address, int length) const;      ///< of the table, gaps included
    Bytes read(int address, int length) const;         ///< 0 where no register stands; inside the table
    void store(const Run &run);

    /// May these bytes be written? Knows access, lengths, ranges, limits; not the lock of the EEPROM area.
    DeviceError check(const Run &run, DeviceError limitError) const;
    std::vector<const Field *> fieldsIn(const Run &run) const;

    void resetEeprom(); ///< factory values, but for Model Number and Firmware Version
    void resetRam();

    const Bytes &image() const { return m_image; }
    void setImage(Bytes image) { m_image = std::move(image); }

private:
    DeviceError checkValue(const Field &field, std::int64_t raw, DeviceError limitError) const;
    const Field *covering(int address) const;
    int target(int address) const;
    void resetArea(bool eeprom);

    ControlTablePtr m_table;
    std::array<const Field *, static_cast<std::size_t>(Reg::Count)> m_known{};
    std::vector<const Field *> m_covering;      ///< by address
    std::vector<const Field *> m_indirectFor;   ///< by address of an Indirect Data byte: its Indirect Address
    Bytes m_image;
};

} // namespace dynascope::sim
