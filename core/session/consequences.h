// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

/// What a write to a register brings besides its new value, told before it. Pure.
namespace dynascope {

enum class ConsequenceKind {
    NeedsTorqueOff,  ///< the register is locked by torque that is on
    Resets,          ///< other registers lose their values
    MovesPosition,   ///< Present Position says something else though nothing moves
    BeyondLimits,    ///< goals, or the place where the joint is, lie beyond what will be allowed
    Jumps,           ///< the joint goes to its goal as soon as torque is on
    Turns,           ///< the motor runs, or pushes, as soon as torque is on
    TorqueByGoal,    ///< a goal turns torque on, this one or those from now on
    StartsByItself,  ///< torque, or RAM values, come with the power
    ChangesPlace,    ///< the device answers elsewhere: ID, baud rate, Secondary ID
    ChangesProtocol, ///< this program will not find it again
    AnswersLess,     ///< Status Return Level
    LosesProtection, ///< a hardware error no longer turns torque off
};

/// A register that changes with the write; nothing where its value isn't known, or the table doesn't state it.
struct ExpectedChange {
    QString name;
    std::optional<std::int64_t> before, after;

    friend bool operator==(const ExpectedChange &, const ExpectedChange &) = default;
};

struct Consequence {
    ConsequenceKind kind = ConsequenceKind::NeedsTorqueOff;
    QString text; ///< a sentence with its stop
    std::vector<ExpectedChange> registers = {};

    /// Should a person hear of it before the write, whatever else they do?
    bool isSerious() const;
};

/// Of writing `raw` to `field` while registers have the values that `now` tells. None where `field` has that value.
/// Numbers are said in `units`.
std::vector<Consequence> consequencesOf(const ControlTable &table, const RegisterLookup &now, const Field &field,
                                        std::int64_t raw, const UnitPreferences &units = {});
bool areSerious(const std::vector<Consequence> &consequences);

/// "Position P Gain: 640 → 800", in `units`.
QString changeText(const ControlTable &table, const RegisterLookup &now, const ExpectedChange &change,
                   const UnitPreferences &units = {});

} // namespace dynascope
