// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/procedures.h"
#include "core/session/settings/registerimage.h"
#include "core/table/controltable.h"

#include <set>

/// Many registers of one device to be set: what is written, in which order. Pure.
namespace dynascope {

struct WantedSetting {
    int field = -1;       ///< index in the device's table
    std::int64_t raw = 0;
};

struct SettingsOptions {
    bool mayTurnTorqueOff = false; ///< where a register needs it; what the motor carries may fall
    bool mayMove = false;          ///< a goal may be written under torque
    bool putTorqueBack = false;    ///< where it was turned off for this and all went well, with the goal at rest
    bool turnTorqueOn = false;     ///< a person's order: in the end, with the goal at rest, also where it was off
    bool keepResets = false;       ///< what a write resets, and isn't wanted itself, is put back to what it was
    bool compareOnly = false;      ///< nothing is written: a dry run
    std::set<int> otherIds = {};   ///< of the line, which no Secondary ID may be
};

/// A limit: a number, or what another register holds.
struct SettingBound {
    std::optional<std::int64_t> number;
    std::optional<RegisterPlace> reg;
    bool isNegated = false;
};

/// Holds where the deciding register, masked, has one of `values`; without one always.
struct SettingRange {
    std::optional<RegisterPlace> decider;
    std::uint32_t mask = 0xFFFFFFFF;
    std::vector<std::int64_t> values;
    SettingBound minimum, maximum;
};

/// One register.
struct SettingsStep {
    RegisterPlace where;
    QString name;                     ///< for messages
    Bytes to;                         ///< empty: what it holds before anything is written (`isKept`)
    bool isKept = false;              ///< put back, because another step's write resets it
    bool isGoal = false;              ///< the motor would follow it
    bool isLocked = false;            ///< torque locks it
    bool isFixed = false;             ///< only ever compared: a change is a procedure of its own (ID, baud rate)
    enum class Tells : std::uint8_t { Nothing, ReturnDelay, ReturnLevel };
    Tells tells = Tells::Nothing;     ///< how the device answers from then on
    std::vector<SettingRange> ranges; ///< the first that holds counts
    std::vector<Span> affected;       ///< what the write may change besides
};

/// The goal that lets the motor rest when torque comes on.
struct RestingGoal {
    std::vector<std::int64_t> modes; ///< of the operating mode; empty: whichever it is
    RegisterPlace goal;
    QString name;
    std::optional<RegisterPlace> present; ///< it becomes what this shows; nothing: 0
};

/// Of every mode of this model; which one counts is for its mode register to say.
std::vector<RestingGoal> restingGoalsOf(const ControlTable &table);
/// Operating Mode, or Control Mode of XL-320; nullptr where there is none.
const Field *modeRegister(const ControlTable &table);
/// Of the present mode; nullptr: nobody knows.
const RestingGoal *restingGoalIn(const std::vector<RestingGoal> &goals, std::optional<std::int64_t> mode);

/// What applySettings() carries out on one device. It knows registers by address only.
struct SettingsPlan {
    DevicePlace place;
    int firmware = -1;                ///< −1: any
    SettingsOptions options;
    std::vector<SettingsStep> steps;  ///< in their order
    std::vector<Span> reads;          ///< all that comparing needs: the steps, what limits them, torque, who it is
    std::vector<Span> affectedReads;  ///< and what the writes may change besides
    std::optional<RegisterPlace> modelNumber, firmwareVersion, torque, mode;
    std::optional<std::uint16_t> driveModeAddress; ///< where its bit 3 lets a goal turn torque on
    std::vector<RestingGoal> restingGoals;
};

/// Why this can't be set by a plan, before any device is asked; empty: it can. `name`d in a sentence without a stop.
QString settingProblem(const ControlTable &table, const DevicePlace &place, const WantedSetting &wanted,
                       const SettingsOptions &options);

/// Orders: what resets others before those, limits and modes before what they bound, EEPROM before RAM, goals behind all
/// of it, Status Return Level at the very end. InvalidArgument names the register: not writable, beyond its range as far
/// as the wanted values tell, wanted twice, or a matter of its own: ID, Baud Rate, Protocol Type, Torque Enable, what
/// leads elsewhere (Indirect Data) or is an order (Hybrid Save). NotSupported: the model is unknown.
Result<SettingsPlan> planSettings(const ControlTable &table, const DevicePlace &place, int firmware,
                                  const std::vector<WantedSetting> &wanted, const SettingsOptions &options);

/// The range that holds while registers have these values; a bound that isn't known is none.
struct KnownRange {
    std::optional<std::int64_t> minimum, maximum;
};
using NumberAt = std::function<std::optional<std::int64_t>(const RegisterPlace &)>;
KnownRange rangeOf(const SettingsStep &step, const NumberAt &numberAt);

} // namespace dynascope
