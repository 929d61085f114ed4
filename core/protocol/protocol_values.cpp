// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/protocol_values.h"

namespace dynascope {

QString instructionName(Instruction instruction)
{
    switch (instruction) {
    case Instruction::Ping: return QStringLiteral("Ping");
    case Instruction::Read: return QStringLiteral("Read");
    case Instruction::Write: return QStringLiteral("Write");
    case Instruction::RegWrite: return QStringLiteral("Reg Write");
    case Instruction::Action: return QStringLiteral("Action");
    case Instruction::FactoryReset: return QStringLiteral("Factory Reset");
    case Instruction::Reboot: return QStringLiteral("Reboot");
    case Instruction::Clear: return QStringLiteral("Clear");
    case Instruction::ControlTableBackup: return QStringLiteral("Control Table Backup");
    case Instruction::Status: return QStringLiteral("Status");
    case Instruction::SyncRead: return QStringLiteral("Sync Read");
    case Instruction::SyncWrite: return QStringLiteral("Sync Write");
    case Instruction::FastSyncRead: return QStringLiteral("Fast Sync Read");
    case Instruction::BulkRead: return QStringLiteral("Bulk Read");
    case Instruction::BulkWrite: return QStringLiteral("Bulk Write");
    case Instruction::FastBulkRead: return QStringLiteral("Fast Bulk Read");
    }
    return QStringLiteral("Instruction 0x%1").arg(static_cast<int>(instruction), 2, 16, QLatin1Char('0'));
}

QString deviceErrorName(DeviceError error)
{
    switch (error) {
    case DeviceError::None: return QStringLiteral("No Error");
    case DeviceError::ResultFail: return QStringLiteral("Result Fail");
    case DeviceError::Instruction: return QStringLiteral("Instruction Error");
    case DeviceError::Crc: return QStringLiteral("CRC Error");
    case DeviceError::DataRange: return QStringLiteral("Data Range Error");
    case DeviceError::DataLength: return QStringLiteral("Data Length Error");
    case DeviceError::DataLimit: return QStringLiteral("Data Limit Error");
    case DeviceError::Access: return QStringLiteral("Access Error");
    }
    return QStringLiteral("Error %1").arg(static_cast<int>(error));
}

QString deviceErrorReason(DeviceError error)
{
    switch (error) {
    case DeviceError::None: return QStringLiteral("nothing is wrong");
    case DeviceError::ResultFail: return QStringLiteral("it could not carry the instruction out in its present state");
    case DeviceError::Instruction:
        return QStringLiteral("it does not know this instruction, or there was nothing to act on");
    case DeviceError::Crc: return QStringLiteral("the request reached it damaged");
    case DeviceError::DataRange: return QStringLiteral("the value is outside the register's range");
    case DeviceError::DataLength: return QStringLiteral("the data is shorter than the register");
    case DeviceError::DataLimit: return QStringLiteral("the value is beyond a limit register");
    case DeviceError::Access:
        return QStringLiteral("the register is read-only, locked while torque is on, or not in its table");
    }
    return QStringLiteral("it gave an error number the manual does not list");
}

} // namespace dynascope
