// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/procedures.h"

#include <set>

namespace dynascope {

/// A stretch of registers that goes from one value to another.
struct RevertRegister {
    std::uint16_t address = 0;
    Bytes from, to;                               ///< what the device must hold (empty: anything), what it shall hold
    QString name;                                 ///< for messages
    bool isGoal = false;                          ///< the motor would follow it; or nobody knows where it leads
    bool isLocked = false;                        ///< in the EEPROM area, which torque locks
    bool isTorque = false;                        ///< Torque Enable itself, which is never switched on
    bool mayWait = true;                          ///< means the same once other registers have been put back
    std::optional<std::uint16_t> indirectAddress; ///< its register that says where it leads: it is looked at
};

/// Puts registers of one device back, the first being what once was written, the others what that write changed
/// besides. Refused before the first write where that isn't the device of then, where it holds other values than those
/// of then, and where torque or motion would have to change that may not. What is there already isn't written.
struct RevertPlan {
    DevicePlace place;
    int firmware = -1; ///< −1: any
    std::vector<RevertRegister> registers;
    std::vector<RevertRegister>
        kept; ///< what putting the first back may change though it didn't then; only the length counts
    std::optional<std::uint16_t> torqueAddress;
    std::vector<Span> goals;                       ///< of the device, for what leads somewhere
    std::optional<std::uint16_t> driveModeAddress; ///< where its bit 3 lets a goal turn torque on
    std::set<std::uint16_t> unchecked;             ///< addresses that may hold anything
    qint64 changedSince = 0;                       ///< a later entry that stands wrote the first register, too; 0: none
    bool readsNothing = false;                     ///< it answers Ping alone until the first register is written
    bool mayMove = false;                          ///< a goal may be written under torque
    bool mayTurnTorqueOff = false;                 ///< what it carries may fall
};

/// Could not be put back yet: a goal that would turn torque on (Drive Mode), or a value that the device refuses for as
/// long as another register (a limit) has not been put back.
struct LeftRegister {
    RevertRegister what;
    QString why;
};

/// What a person has to allow first.
enum class Consent {
    None,
    Motion,    ///< a motor would move
    TorqueOff, ///< torque would go off; what it carries may fall
};

struct Reverted {
    Consent missing = Consent::None; ///< else nothing was written, and `why` says it
    QString why;
    std::vector<PollValue> before, after; ///< the registers of the plan, in stretches
    std::vector<LeftRegister> left;
    bool torqueTurnedOff = false; ///< to unlock the EEPROM
    bool torqueStaysOff = false;  ///< it was on once, and is not switched on
};

/// Errors: InvalidArgument and NotFound: nothing was written, and why. NotConfirmed and those of the bus: the registers
/// may hold either value; the same once more puts them right.
Result<Reverted> revert(JobContext &context, const RevertPlan &plan);

} // namespace dynascope
