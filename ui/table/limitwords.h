// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

#include <QString>

namespace dynascope {

/// What the grid says of a register's range and factory value.

/// "0 … 4095"; "any" where that is all that four bytes hold, empty where nothing is stated. "?" for the limit that a
/// register says which wasn't read yet.
QString rangeText(const Field &field, const EffectiveField &effective);
/// The same in the unit that was chosen: "0.00 … 359.91 °". Raw where the values have names, or no unit.
QString rangeText(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units);
/// "set by Min Position Limit and Max Position Limit"; empty where no register sets it.
QString rangeSource(const EffectiveField &effective);
/// The range in its unit and raw, and what sets it; for a tool tip.
QString rangeToolTip(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units);

/// The factory's value as a number in the unit that was chosen, "180.00", which the value beside it names; raw where the
/// values have names, or raw numbers were chosen. Empty where none is stated.
QString defaultText(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units);
QString defaultToolTip(const Field &field, const EffectiveField &effective, int resolution,
                       const UnitPreferences &units); ///< raw, too

} // namespace dynascope
