// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

namespace dynascope {

/// How positions are shown.
enum class AngleUnit { Degrees, Radians, Pulses };

/// A number with its unit, for people.
struct Physical {
    double value = 0;
    QString unit;     ///< "°", "rev/min", "mA"; empty for bare numbers
    int decimals = 0; ///< as many as tell neighbouring raw values apart
};

/// `raw` in the field's present unit (see effective()).
Physical physical(const EffectiveField &field, int resolution, std::int64_t raw, AngleUnit angle = AngleUnit::Degrees);
/// The nearest raw value; not range-checked.
std::int64_t rawFromPhysical(const EffectiveField &field, int resolution, double value,
                             AngleUnit angle = AngleUnit::Degrees);
QString unitSymbol(Unit unit, AngleUnit angle = AngleUnit::Degrees); ///< for people: "°", "rev/min²"
QString unitId(Unit unit);                                          ///< for programs: "deg", "rev/min2"

/// The enum's name or the bits' names that `raw` stands for; empty where the field has neither.
QString meaning(const Field &field, std::int64_t raw);
/// "180.00 °", "On", "Position control"; the raw number where there is nothing better.
QString valueText(const Field &field, const EffectiveField &effective, int resolution, std::int64_t raw,
                  AngleUnit angle = AngleUnit::Degrees);

/// What a person typed: a raw number (decimal, 0x…, negative); a number with a unit (90deg, 30rpm, 200mA, 12.1V,
/// 50%, 1.5turn); the name of an enum value or, joined by '+' or ',', of bits. Checked against type, range and
/// the enum; the message says what would be allowed.
Result<std::int64_t> parseValue(const Field &field, const EffectiveField &effective, int resolution, QStringView text,
                                AngleUnit angle = AngleUnit::Degrees);
/// Is `raw` allowed? The message names the register and its range.
Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw);
/// The same, and for positions the message also says the angles.
Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw, int resolution,
                        AngleUnit angle = AngleUnit::Degrees);

} // namespace dynascope
