// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/backup.h"

/// Two backups side by side, whether of files or of devices. Pure.
namespace dynascope {

/// What a register is to somebody who compares.
enum class BackupUse {
    Setting,
    Calibration, ///< of one single device: Homing Offset
    Place,       ///< ID and baud rate
    Motion,      ///< torque, goals and what leads to them: never restored
    Order,       ///< makes the device do something: never restored
    Identity,    ///< model and firmware: can't change
    Reading,     ///< volatile: Present Position, Realtime Tick, Moving...
};
BackupUse backupUse(const ControlTable &table, const Field &field);

struct ComparedRegister {
    enum class State {
        Same,
        Differs,
        OnlyHere,
        OnlyThere,
        OtherMeaning, ///< the same number would mean something else there: not comparable
    };
    QString name;
    BackupUse use = BackupUse::Setting;
    State state = State::Same;
    std::optional<std::int64_t> here, there;
    QString hereText, thereText; ///< "180.00 °"; empty where there is no value
    QString why;                 ///< of OtherMeaning

    bool isReading() const { return use == BackupUse::Reading; }
    bool isSame() const { return state == State::Same; }
};

/// By register name, in the order of `here`'s addresses, then what only `there` has; bytes without a register are rows
/// named by their address, where they differ.
std::vector<ComparedRegister> compareBackups(const Backup &here, const Backup &there);
std::size_t countOf(const std::vector<ComparedRegister> &rows, ComparedRegister::State state); ///< readings left out

/// Why this raw value means something else in another table, a sentence without its stop; empty: it means the same.
/// `lookup`: the registers of `from`'s device.
QString otherMeaning(const ControlTable &fromTable, const Field &from, const ControlTable &toTable, const Field &to,
                     std::int64_t raw, const RegisterLookup &lookup);

/// @name Words for programs: "differs", "only-here"; "setting", "calibration"
/// @{
QString wordOf(ComparedRegister::State state);
QString wordOf(BackupUse use);
/// @}

} // namespace dynascope
