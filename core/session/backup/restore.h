// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/comparebackups.h"
#include "core/session/settings/settingsplan.h"

/// From a backup to what is written. Pure; applySettings() carries it out.
namespace dynascope {

struct RestoreOptions {
    SettingsOptions settings;        ///< `keepResets` is set anyway
    std::optional<bool> calibration; ///< with what belongs to one single device; nothing: where it seems to be that one
    QStringList only, except;        ///< registers by name; `only` empty: all
};

struct RestoreRow {
    enum class State {
        Same,
        Differs,    ///< to be written
        Left,       ///< on purpose, `why` says it
        NotCarried, ///< this device can't take it, `why` says it
    };
    QString name;
    BackupUse use = BackupUse::Setting;
    State state = State::Same;
    int field = -1; ///< in the device's table; −1: nothing would be written there
    std::optional<std::int64_t> now;
    std::int64_t wanted = 0;
    QString nowText, wantedText;
    QString why;
};

struct RestorePlan {
    std::vector<RestoreRow> rows; ///< of each register that the file has and that may be written, in its order
    std::vector<WantedSetting> wanted;
    SettingsPlan settings;     ///< of all that is carried, also of what is the same: a write may reset it
    bool isSameDevice = false; ///< by model, firmware, ID: as far as that can be told

    std::size_t count(RestoreRow::State state) const;
    bool writesNothing() const { return count(RestoreRow::State::Differs) == 0; }
};

/// `now`: what the device holds, just read. Never Torque Enable, a goal, ID or baud rate. To another firmware by name;
/// what it hasn't, or means something else by, or bounds tighter is NotCarried,
/// and so is what another register of the file forbids. InvalidArgument: the file is of another
/// model, or a register of it is beyond any range (with its place in the file), or `only`/`except` name no register;
/// nothing is to be written then.
Result<RestorePlan> planRestore(const Backup &backup, const Backup &now, const DevicePlace &place,
                                const RestoreOptions &options);

QString wordOf(RestoreRow::State state); ///< for programs: "same", "differs", "left", "not-carried"

/// What Control Table Backup needs and does, for people: sentences.
QString inServoConditions();
/// Why this device can't do it now, a sentence without its stop; empty: it can. `torque`, `ready`: as the registers
/// Torque Enable and Backup Ready read; nothing where that isn't known.
QString inServoProblem(const ControlTable &table, int firmware, bool restore, std::optional<std::int64_t> torque,
                       std::optional<std::int64_t> ready);

} // namespace dynascope
