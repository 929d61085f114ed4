// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profile.h"
#include "core/table/units.h"

/// What a profile's texts mean for one device. Pure.
namespace dynascope {

/// A register's value in both units.
struct ProfileValue {
    std::int64_t raw = 0;
    double value = 0; ///< in `unit`
    QString unit;     ///< for programs: "deg"; empty: a bare number
    QString text;     ///< for people: "180.00 °", "Position control"

    friend bool operator==(const ProfileValue &, const ProfileValue &) = default;
};
ProfileValue profileValue(const ControlTable &table, const Field &field, std::int64_t raw, const RegisterLookup &lookup);

/// What a register of a joint shall hold in a device of this table.
struct WantedValue {
    const Field *field = nullptr; ///< nullptr: its firmware has no such register
    Result<std::int64_t> raw = 0; ///< InvalidArgument: why it can't be that
};

/// One for each of the joint's registers. Units and ranges are those that hold once all of it has been written; what the
/// joint doesn't name is as `held` says, which may know nothing.
std::vector<WantedValue> wantedValues(const ProfileJoint &joint, const ControlTable &table, const RegisterLookup &held);
/// Registers as they will be: as wanted, else as `held` says. `wanted` and `held` outlive it.
RegisterLookup lookupAfter(const ControlTable &table, const std::vector<WantedValue> &wanted,
                           const RegisterLookup &held);

/// The registers whose values the meaning of this one hangs on: those that decide its unit, and those that limit it.
QStringList deciders(const Field &field);

/// How a value is written into a file so that reading it gives the same raw value: a name or a number with its unit,
/// else the raw number. `like` is the text that it replaces: raw stays raw, and an angle keeps its unit.
QString textOfValue(const ControlTable &table, const Field &field, std::int64_t raw, const RegisterLookup &lookup,
                    QStringView like = {});

} // namespace dynascope
