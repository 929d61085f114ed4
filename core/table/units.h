// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

namespace dynascope {

constexpr bool isAngle(Unit unit)
{
    return unit == Unit::Pulse || unit == Unit::Degree;
}

/// How positions are shown.
enum class AngleUnit { Degrees, Radians, Pulses, Turns };

/// What a person chose, once for everything that is shown.
struct UnitPreferences {
    AngleUnit angle = AngleUnit::Degrees;
    bool torque = false; ///< currents as Nm, where the model's torque constant is stated
    bool raw = false;    ///< bare register values

    UnitPreferences() = default;
    UnitPreferences(AngleUnit angleUnit) : angle(angleUnit) { } // NOLINT(*-explicit-*): it is one
    friend bool operator==(const UnitPreferences &, const UnitPreferences &) = default;
};

/// A number with its unit, for people.
struct Physical {
    double value = 0;
    QString unit;     ///< "°", "rev/min", "mA"; empty for bare numbers
    int decimals = 0; ///< as many as tell neighbouring raw values apart
};

/// `raw` in the field's present unit (see effective()). `resolution` is the table's.
Physical physical(
    const EffectiveField &field, int resolution, std::int64_t raw, const UnitPreferences &units = {});
/// The nearest raw value; not range-checked. −0 has a raw value of its own where a bit is the direction.
std::int64_t rawFromPhysical(
    const EffectiveField &field, int resolution, double value, const UnitPreferences &units = {});
/// The lowest and highest of the raw values from `low` to `high`. They aren't those of `low` and `high` where a bit is
/// the direction.
std::pair<Physical, Physical> physicalRange(const EffectiveField &field, int resolution, std::int64_t low,
                                            std::int64_t high, const UnitPreferences &units = {});
/// A raw value as what it counts: negative where a bit says so (EffectiveField::directionBit), else `raw` itself.
std::int64_t signedFromRaw(const EffectiveField &field, std::int64_t raw);
std::int64_t rawFromSigned(const EffectiveField &field, std::int64_t value); ///< the nearest there is
/// What may be written, counted so; the smallest first.
std::pair<std::int64_t, std::int64_t> signedRange(const Field &field, const EffectiveField &effective);
QString unitSymbol(const EffectiveField &field, const UnitPreferences &units = {}); ///< for people, as physical() says
QString unitSymbol(Unit unit, AngleUnit angle = AngleUnit::Degrees); ///< for people: "°", "rev/min²"
QString unitId(Unit unit);                                          ///< for programs: "deg", "rev/min2"
QString tableUnit(Unit unit);                                       ///< as table files call it: "pulse", "rev/min2"
std::optional<Unit> unitFromTable(QStringView name);

/// The enum's name or the bits' names that `raw` stands for; empty where the field has neither.
QString meaning(const Field &field, std::int64_t raw);
/// "180.00 °", "On", "Position control"; the raw number where there is nothing better. parseValue() makes `raw` of it.
QString valueText(const Field &field, const EffectiveField &effective, int resolution, std::int64_t raw,
                  const UnitPreferences &units = {});

/// What a person typed: a raw number (decimal, 0x…, negative); a number with a unit (90deg, 30rpm, 200mA, 12.1V,
/// 50%, 1.5turn, 0.8Nm); the name of an enum value or, joined by '+' or ',', of bits. Checked against type, range and
/// the enum; the message says what would be allowed.
Result<std::int64_t> parseValue(const Field &field, const EffectiveField &effective, int resolution, QStringView text,
                                const UnitPreferences &units = {});
/// Is `raw` allowed? The message names the register and its range.
Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw);
/// The same, and for positions the message also says the angles.
Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw, int resolution,
                        const UnitPreferences &units = {});

} // namespace dynascope
