// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/revert.h"
#include "core/session/settings/settingsplan.h"

namespace dynascope {

/// One write while settings are applied.
struct SettingsWrite {
    enum class Purpose {
        Setting,     ///< wanted
        PutBack,     ///< what another one has reset
        TorqueOff,   ///< to unlock the EEPROM
        RestingGoal, ///< so that nothing moves when torque comes on
        TorqueOn,    ///< as it was before
    };
    Purpose purpose = Purpose::Setting;
    RegisterPlace where;
    QString name;
    Bytes before; ///< empty: not known
    Bytes to;
    std::vector<PollValue> around = {}; ///< what itself and what it may change hold before it, as far as that was read
    QString ahead = {};                 ///< its key, where it was noted on the bus thread
};

/// Told of each write, on the bus thread: before its packet, and what was read before and after, itself first.
struct SettingsHooks {
    std::function<QString(const SettingsWrite &write)> ahead; ///< called by posted() on the bus thread, before begun
    std::function<void(const SettingsWrite &write)> begun;
    std::function<void(const SettingsWrite &write, std::span<const PollValue> before,
                       const Result<std::vector<PollValue>> &after)>
        ended;
};

enum class SettingState {
    Same,    ///< it was so already
    Differs, ///< and was not written: a dry run, or it came to its end before
    Written, ///< and read back
    Left,    ///< on purpose, `why` says it
    Failed,  ///< the device did not take it, `why` says it
};

struct SettingResult {
    SettingState state = SettingState::Differs;
    Bytes before, after; ///< as read; empty: not known
    QString why;
};

struct SettingsOutcome {
    Consent missing = Consent::None;    ///< then nothing was written, and `why` says it
    QString why;
    std::vector<SettingResult> results; ///< one per step of the plan
    std::optional<Error> ended;         ///< it came to its end before all was done; the same plan once more goes on
    bool hadTorque = false;
    bool needsTorqueOff = false; ///< what differs is locked by torque that is on
    bool moves = false;          ///< what differs is a goal, and torque is on
    bool torqueTurnedOff = false, torqueIsBack = false; ///< the latter: it was turned on
    QString torqueNote; ///< why torque did not come back though it was to

    bool isDone() const; ///< all that was wanted holds, or was left on purpose
    std::size_t count(SettingState state) const;
    bool torqueStaysOff() const { return torqueTurnedOff && !torqueIsBack; }
};

/// Is this the device of the plan, by Model Number and Firmware Version as read? NotFound: another one.
Result<void> checkIdentity(const SettingsPlan &plan, const RegisterImage &image);

/// What differs, of what was read (SettingsPlan::reads). Pure.
SettingsOutcome compareSettings(const SettingsPlan &plan, const RegisterImage &image);

/// Could what differs be written as it is wanted? Says in `outcome` which consent is missing; InvalidArgument: a value is
/// beyond the range that will hold in the end. Pure.
Result<void> checkDifferences(const SettingsPlan &plan, const RegisterImage &image, SettingsOutcome &outcome);

/// Brings one device to what is wanted: looks whether it is the one, reads, writes what differs, each write verified,
/// with a checkpoint between two of them. Torque is turned off only where that is needed and allowed, and turned on only
/// where SettingsOptions say so. Errors: nothing was written, and why.
Result<SettingsOutcome> applySettings(JobContext &context, const SettingsPlan &plan, const SettingsHooks &hooks = {});

} // namespace dynascope
