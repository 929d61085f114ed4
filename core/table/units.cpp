// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope {
namespace {

struct UnitName {
    const char16_t *name;
    Unit unit;
};

/// In table files.
constexpr UnitName UnitNames[] = {
    {u"", Unit::None},
    {u"pulse", Unit::Pulse},
    {u"deg", Unit::Degree},
    {u"rev/min", Unit::RevPerMin},
    {u"rev/min2", Unit::RevPerMin2},
    {u"mA", Unit::MilliAmpere},
    {u"A", Unit::Ampere},
    {u"%", Unit::Percent},
    {u"V", Unit::Volt},
    {u"degC", Unit::Celsius},
    {u"us", Unit::Microsecond},
    {u"ms", Unit::Millisecond},
    {u"mV/ms", Unit::MilliVoltPerMs},
    {u"Hz", Unit::Hertz},
    {u"pulse/s", Unit::PulsePerSec},
    {u"pulse/ms", Unit::PulsePerMs},
};

/// How many of it are a pulse per second; 0 for what doesn't count pulses by time.
double pulsesPerSecond(Unit unit)
{
    return unit == Unit::PulsePerSec ? 1.0 : unit == Unit::PulsePerMs ? 1000.0 : 0.0;
}

bool isShownAsTorque(const EffectiveField &field, const UnitPreferences &units)
{
    return units.torque && field.torqueConstant > 0 && (field.unit == Unit::MilliAmpere || field.unit == Unit::Ampere);
}

double turn(AngleUnit angle)
{
    return angle == AngleUnit::Degrees ? 360.0 : angle == AngleUnit::Radians ? 2.0 * std::numbers::pi : 1.0;
}

/// One raw step in the shown unit.
double step(const EffectiveField &field, int resolution, const UnitPreferences &units)
{
    const double pulses = pulsesPerSecond(field.unit);
    if (pulses > 0 && !units.raw && units.angle != AngleUnit::Pulses)
        return field.scale * pulses * turn(units.angle) / (std::max(1, resolution) * field.turns);
    if (units.raw || (isAngle(field.unit) && units.angle == AngleUnit::Pulses))
        return field.unit == Unit::Pulse && !units.raw ? field.scale : 1.0;
    if (isShownAsTorque(field, units))
        return field.torqueConstant;
    if (field.unit == Unit::Degree)
        return field.scale * turn(units.angle) / 360.0;
    if (field.unit == Unit::Pulse)
        return field.scale * turn(units.angle) / (std::max(1, resolution) * field.turns);
    return field.scale;
}

/// The fewest decimals whose last digit is finer than one raw step, or just as fine.
int decimalsFor(double step)
{
    constexpr double Same = 1e-9, Finer = 0.95; // no double is a tenth; and neighbours stay apart after rounding
    const double size = std::abs(step);
    int decimals = 0;
    for (double digit = 1.0; decimals < 9; digit /= 10, ++decimals) {
        if (digit <= size * Finer || std::abs(digit - size) <= size * Same)
            break;
    }
    return decimals;
}

std::int64_t directionMask(const EffectiveField &field)
{
    return std::int64_t(1) << field.directionBit;
}

const EnumValue *named(const std::vector<EnumValue> &values, std::int64_t raw)
{
    const auto found = std::find_if(values.begin(), values.end(), [&](const EnumValue &v) { return v.value == raw; });
    return found == values.end() ? nullptr : &*found;
}

QString bitsMeaning(const Field &field, std::int64_t raw)
{
    QStringList names;
    std::int64_t rest = raw;
    for (const BitField &bit : field.bits) {
        const std::int64_t ones = (std::int64_t(1) << bit.count) - 1;
        const std::int64_t value = (raw >> bit.first) & ones;
        rest &= ~(ones << bit.first);
        if (value == 0)
            continue;
        const EnumValue *text = bit.count > 1 ? named(bit.values, value) : nullptr;
        if (text)
            names.append(text->text);
        else if (bit.count == 1)
            names.append(bit.name);
        else
            rest |= value << bit.first;
    }
    for (int i = 0; i < 8 * field.size; ++i) {
        if (rest >> i & 1)
            names.append(QStringLiteral("bit %1").arg(i));
    }
    return names.isEmpty() ? QStringLiteral("None") : names.join(QStringLiteral(", "));
}

QString fixed(const Physical &shown)
{
    const QString digits = QString::number(std::abs(shown.value), 'f', shown.decimals);
    // Also of −0, which is another raw value than 0.
    return std::signbit(shown.value) ? u'-' + digits : digits;
}

QString listed(const std::vector<EnumValue> &values)
{
    QStringList texts;
    for (const EnumValue &value : values)
        texts.append(QStringLiteral("%1 (%2)").arg(value.value).arg(value.text));
    return texts.join(QStringLiteral(", "));
}

/// Where a name begins with this number ("57600 bps") the name was meant, or its code.
QString likelyMeant(const std::vector<EnumValue> &values, std::int64_t raw)
{
    const auto begins = [raw](const EnumValue &value) { return value.text.startsWith(QStringLiteral("%1 ").arg(raw)); };
    const auto meant = std::ranges::find_if(values, begins);
    if (meant == values.end())
        return {};
    return QStringLiteral("; write %1 or %2").arg(normalizedName(meant->text)).arg(meant->value);
}

} // namespace

Physical physical(const EffectiveField &field, int resolution, std::int64_t raw, const UnitPreferences &units)
{
    const double one = step(field, resolution, units);
    double value = static_cast<double>(raw);
    if (field.directionBit >= 0 && !units.raw) {
        const std::int64_t direction = directionMask(field);
        value = static_cast<double>(raw & ~direction);
        if ((raw & direction) != 0)
            value = -value; // −0, too
    }
    return {value * one, unitSymbol(field, units), decimalsFor(one)};
}

std::int64_t rawFromPhysical(const EffectiveField &field, int resolution, double value, const UnitPreferences &units)
{
    // Wide enough for every register, and exact in a double.
    constexpr double Largest = 1e15;
    const double steps = value / step(field, resolution, units);
    if (std::isnan(steps))
        return 0;
    const std::int64_t raw = std::llround(std::clamp(steps, -Largest, Largest));
    if (field.directionBit < 0 || units.raw)
        return raw;
    const std::int64_t direction = directionMask(field);
    std::int64_t magnitude = std::abs(raw);
    if ((magnitude & direction) != 0)
        magnitude = direction - 1; // there is no room for more
    return std::signbit(steps) ? magnitude | direction : magnitude;
}

std::pair<Physical, Physical> physicalRange(
    const EffectiveField &field, int resolution, std::int64_t low, std::int64_t high, const UnitPreferences &units)
{
    if (field.directionBit < 0 || units.raw || high < directionMask(field))
        return {physical(field, resolution, low, units), physical(field, resolution, high, units)};
    const std::int64_t most = directionMask(field) - 1;
    return {physical(field, resolution, most | directionMask(field), units), physical(field, resolution, most, units)};
}

std::int64_t signedFromRaw(const EffectiveField &field, std::int64_t raw)
{
    if (field.directionBit < 0)
        return raw;
    const std::int64_t magnitude = raw & ~directionMask(field);
    return (raw & directionMask(field)) != 0 ? -magnitude : magnitude;
}

std::int64_t rawFromSigned(const EffectiveField &field, std::int64_t value)
{
    if (field.directionBit < 0)
        return value;
    const std::int64_t magnitude = std::min(std::abs(value), directionMask(field) - 1);
    return value < 0 ? magnitude | directionMask(field) : magnitude;
}

std::pair<std::int64_t, std::int64_t> signedRange(const Field &field, const EffectiveField &effective)
{
    const std::int64_t low = std::max(effective.minimum.value_or(smallestRaw(field)), smallestRaw(field));
    const std::int64_t high = std::min(effective.maximum.value_or(largestRaw(field)), largestRaw(field));
    if (effective.directionBit < 0 || high < directionMask(effective))
        return {low, std::max(low, high)};
    const std::int64_t most = directionMask(effective) - 1;
    return {-most, most};
}

QString unitSymbol(const EffectiveField &field, const UnitPreferences &units)
{
    if (units.raw)
        return {};
    return isShownAsTorque(field, units) ? QStringLiteral("Nm") : unitSymbol(field.unit, units.angle);
}

QString unitSymbol(Unit unit, AngleUnit angle)
{
    switch (unit) {
    case Unit::None: return {};
    case Unit::Pulse:
    case Unit::Degree: break;
    case Unit::PulsePerSec:
    case Unit::PulsePerMs:
        return angle == AngleUnit::Pulses ? tableUnit(unit) : unitSymbol(Unit::Pulse, angle) + QStringLiteral("/s");
    case Unit::RevPerMin: return QStringLiteral("rev/min");
    case Unit::RevPerMin2: return QStringLiteral("rev/min²");
    case Unit::MilliAmpere: return QStringLiteral("mA");
    case Unit::Ampere: return QStringLiteral("A");
    case Unit::Percent: return QStringLiteral("%");
    case Unit::Volt: return QStringLiteral("V");
    case Unit::Celsius: return QStringLiteral("°C");
    case Unit::Microsecond: return QStringLiteral("µs");
    case Unit::Millisecond: return QStringLiteral("ms");
    case Unit::MilliVoltPerMs: return QStringLiteral("mV/ms");
    case Unit::Hertz: return QStringLiteral("Hz");
    }
    switch (angle) {
    case AngleUnit::Degrees: return QStringLiteral("°");
    case AngleUnit::Radians: return QStringLiteral("rad");
    case AngleUnit::Pulses: return QStringLiteral("pulse");
    case AngleUnit::Turns: return QStringLiteral("turn");
    }
    return {};
}

QString unitId(Unit unit)
{
    switch (unit) {
    case Unit::Pulse:
    case Unit::Degree: return QStringLiteral("deg");
    case Unit::PulsePerSec:
    case Unit::PulsePerMs: return QStringLiteral("deg/s");
    case Unit::RevPerMin2: return QStringLiteral("rev/min2");
    case Unit::Celsius: return QStringLiteral("degC");
    case Unit::Microsecond: return QStringLiteral("us");
    default: return unitSymbol(unit);
    }
}

QString tableUnit(Unit unit)
{
    const auto *const found = std::ranges::find(UnitNames, unit, &UnitName::unit);
    return QString::fromUtf16(found->name);
}

std::optional<Unit> unitFromTable(QStringView name)
{
    const auto *const found
        = std::ranges::find_if(UnitNames, [&](const UnitName &unit) { return name == QStringView(unit.name); });
    return found == std::end(UnitNames) || name.isEmpty() ? std::nullopt : std::optional(found->unit);
}

QString meaning(const Field &field, std::int64_t raw)
{
    if (const EnumValue *value = named(field.values, raw))
        return value->text;
    if (const EnumValue *value = named(field.special, raw))
        return value->text;
    return field.bits.empty() ? QString() : bitsMeaning(field, raw);
}

QString valueText(
    const Field &field, const EffectiveField &effective, int resolution, std::int64_t raw, const UnitPreferences &units)
{
    const QString name = meaning(field, raw);
    if (!name.isEmpty())
        return name;
    if (effective.unit == Unit::None || units.raw)
        return QString::number(raw);
    const Physical shown = physical(effective, resolution, raw, units);
    return fixed(shown) + u' ' + shown.unit;
}

Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw)
{
    return checkRange(field, effective, raw, 1, AngleUnit::Pulses);
}

Result<void> checkRange(
    const Field &field, const EffectiveField &effective, std::int64_t raw, int resolution, const UnitPreferences &units)
{
    if (!field.values.empty() && !named(field.values, raw)) {
        return failure(ErrorKind::InvalidArgument,
            QStringLiteral("%1 can't be %2; it is one of %3%4")
                .arg(field.name).arg(raw).arg(listed(field.values), likelyMeant(field.values, raw)));
    }
    const std::int64_t low = std::max(effective.minimum.value_or(smallestRaw(field)), smallestRaw(field));
    const std::int64_t high = std::min(effective.maximum.value_or(largestRaw(field)), largestRaw(field));
    if (raw >= low && raw <= high)
        return {};
    QString value = QString::number(raw);
    QString range = QStringLiteral("%1 to %2").arg(low).arg(high);
    const QString symbol = unitSymbol(effective, units);
    if (!symbol.isEmpty() && symbol != u"pulse") {
        const auto [from, to] = physicalRange(effective, resolution, low, high, units);
        // Beyond its bits a direction and what it counts are nothing that the number says.
        if (effective.directionBit < 0) {
            const Physical wanted = physical(effective, resolution, raw, units);
            value += QStringLiteral(" (%1 %2)").arg(fixed(wanted), wanted.unit);
        }
        range += QStringLiteral(" (%1 to %2 %3)").arg(fixed(from), fixed(to), to.unit);
    }
    return failure(
        ErrorKind::InvalidArgument, QStringLiteral("%1 can't be %2; its range is %3").arg(field.name, value, range));
}

} // namespace dynascope
