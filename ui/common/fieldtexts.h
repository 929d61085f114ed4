// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

namespace dynascope {

/// What registers are, in words that the control table and the library of tables share.

QString areaText(Area area);              ///< "EEPROM"
QString accessText(const Field &field);   ///< "read only", "read and write"
QString factsText(const Field &field);    ///< "address 102 · 2 bytes · RAM · read and write"
QString meaningsText(const Field &field); ///< rich text: what its values or bits are called; empty where they aren't
/// "0 … 4095 (0.00 ° … 359.91 °)"; one number where both are the same, nothing where one isn't known.
QString withUnits(const Field &field, const EffectiveField &effective, int resolution, const UnitPreferences &units,
                  const std::optional<std::int64_t> &from, const std::optional<std::int64_t> &to);

} // namespace dynascope
