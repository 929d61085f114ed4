// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/protocol_values.h"
#include "core/table/controltable.h"

#include <array>

namespace dynascope::sim {

/// The registers whose meaning the simulator knows; names in registernames.cpp.
enum class Reg {
    ModelNumber, FirmwareVersion, Id, BaudRate, ReturnDelayTime, DriveMode, OperatingMode, SecondaryId, ProtocolType,
    HomingOffset, MovingThreshold, TemperatureLimit, MaxVoltageLimit, MinVoltageLimit, PwmLimit, CurrentLimit,
    VelocityLimit, MaxPositionLimit, MinPositionLimit, StartupConfiguration, PwmSlope, Shutdown, InPositionThreshold,
    FollowingErrorThreshold, TorqueEnable, Led, StatusReturnLevel, RegisteredInstruction, HardwareErrorStatus,
    ErrorCode, HybridSave, VelocityIGain, VelocityPGain, PositionDGain, PositionIGain, PositionPGain,
    Feedforward2ndGain, Feedforward1stGain, BusWatchdog, GoalPwm, GoalCurrent, GoalVelocity, ProfileAcceleration, ProfileVelocity,
    ProfileAccelerationTime, ProfileTime, GoalPosition, RealtimeTick, Moving, MovingStatus, PresentPwm, PresentCurrent,
    PresentLoad, PresentVelocity, PresentPosition, VelocityTrajectory, PositionTrajectory, PresentInputVoltage,
    PresentTemperature, BackupReady,
    Count
};
/// As this table's series calls it; nullptr where the model has no such register.
const Field *findRegister(const ControlTable &table, Reg reg);

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
    std::int64_t initial(Reg reg) const;       ///< factory value; where the table states none a usual gain, or 0
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
    struct Refusals {
        DeviceError beyondLimit = DeviceError::DataLimit;    ///< of a limit register
        DeviceError misaligned = DeviceError::DataLength;    ///< begins inside a register
    };
    DeviceError check(const Run &run, const Refusals &refusals) const;
    std::vector<const Field *> fieldsIn(const Run &run) const;

    void resetEeprom(); ///< factory values, but for Model Number and Firmware Version
    void resetRam();    ///< and what may be stored on request goes back to what is stored

    /// @name What a loss of power leaves: the registers of the EEPROM area, and those stored on request
    /// @{
    static bool isKept(const Field &field) { return field.area != Area::Ram; }
    void keep(const Field &field, ByteView value);
    void keepAll();   ///< as they are now
    void losePower(); ///< back to what was kept, RAM to factory values
    /// @}

    const Bytes &image() const { return m_image; }
    void setImage(Bytes image) { m_image = std::move(image); }
    ByteView bytes(const Field &field) const { return ByteView(m_image).subspan(field.address, field.size); }

private:
    DeviceError checkValue(const Field &field, std::int64_t raw, DeviceError limitError) const;
    bool isAllowed(const Field &field, std::int64_t raw) const;
    std::int64_t initialOf(const Field &field) const;
    const Field *covering(int address) const;
    int target(int address) const;

    ControlTablePtr m_table;
    std::array<const Field *, static_cast<std::size_t>(Reg::Count)> m_known{};
    std::vector<const Field *> m_covering;      ///< by address
    std::vector<const Field *> m_indirectFor;   ///< by address of an Indirect Data byte: its Indirect Address
    Bytes m_image, m_kept;
};

} // namespace dynascope::sim
