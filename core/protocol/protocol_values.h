// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <cstdint>

/// The numbers of DYNAMIXEL Protocol 2.0 that are not registers.
namespace dynascope {

constexpr std::uint8_t MaximumId = 252;   ///< devices have 0..252
constexpr std::uint8_t BroadcastId = 254; ///< everyone listens
constexpr int MaximumPacketSize = 1024;   ///< bytes after stuffing; the receive buffer of most devices
/// Bits per second: what is above can't be meant, wherever it is read or typed. The fastest device does 10.5 million.
constexpr int HighestBaudRate = 100'000'000;

/// Manual: "Instruction".
enum class Instruction : std::uint8_t {
    Ping = 0x01,
    Read = 0x02,
    Write = 0x03,
    RegWrite = 0x04,
    Action = 0x05,
    FactoryReset = 0x06,
    Reboot = 0x08,
    Clear = 0x10,
    ControlTableBackup = 0x20,
    Status = 0x55,
    SyncRead = 0x82,
    SyncWrite = 0x83,
    FastSyncRead = 0x8A,
    BulkRead = 0x92,
    BulkWrite = 0x93,
    FastBulkRead = 0x9A,
};

/// Bits 6..0 of a status packet's error field: a number, not a mask. Manual: "Error".
enum class DeviceError : std::uint8_t {
    None = 0,
    ResultFail = 1,
    Instruction = 2,
    Crc = 3,
    DataRange = 4,
    DataLength = 5,
    DataLimit = 6,
    Access = 7,
};

constexpr std::uint8_t AlertBit = 0x80; ///< bit 7 of the error field: Hardware Error Status is not 0

/// Parameter of Factory Reset.
enum class ResetOption : std::uint8_t {
    All = 0xFF,
    AllButId = 0x01,
    AllButIdAndBaud = 0x02,
};

/// First parameter of Clear.
enum class ClearOption : std::uint8_t {
    Position = 0x01, ///< multi-turn information
    Error = 0x02,    ///< Y series only
};

/// First parameter of Control Table Backup.
enum class BackupOption : std::uint8_t {
    Store = 0x01,
    Restore = 0x02,
};

QString instructionName(Instruction instruction); ///< as the manual writes it: "Sync Read"
QString deviceErrorName(DeviceError error);       ///< as the manual writes it: "Data Range Error"
QString deviceErrorReason(DeviceError error);     ///< what that means to a person, a clause

} // namespace dynascope
