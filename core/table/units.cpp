// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynascope {
namespace {

/// One raw step in the shown unit.
double step(const EffectiveField &field, int resolution, AngleUnit angle)
{
    if (field.unit != Unit::Pulse || angle == AngleUnit::Pulses)
        return field.scale;
    const double turn = angle == AngleUnit::Degrees ? 360.0 : 2.0 * std::numbers::pi;
    return field.scale * turn / std::max(1, resolution);
}

/// The fewest decimals whose last digit is no coarser than one raw step.
int decimalsFor(double step)
{
    int decimals = 0;
    // The small allowance takes 0.1 for a tenth, though no double is one.
    for (double digit = 1.0; digit > std::abs(step) * (1 + 1e-9) && decimals < 9; digit /= 10)
        ++decimals;
    return decimals;
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
    return QString::number(shown.value, 'f', shown.decimals);
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

Physical physical(const EffectiveField &field, int resolution, std::int64_t raw, AngleUnit angle)
{
    const double one = step(field, resolution, angle);
    return {static_cast<double>(raw) * one, unitSymbol(field.unit, angle), decimalsFor(one)};
}

std::int64_t rawFromPhysical(const EffectiveField &field, int resolution, double value, AngleUnit angle)
{
    // Wide enough for every register, and exact in a double.
    constexpr double Largest = 1e15;
    const double raw = value / step(field, resolution, angle);
    if (std::isnan(raw))
        return 0;
    return std::llround(std::clamp(raw, -Largest, Largest));
}

QString unitSymbol(Unit unit, AngleUnit angle)
{
    switch (unit) {
    case Unit::None: return {};
    case Unit::Pulse:
        return angle == AngleUnit::Degrees ? QStringLiteral("°")
            : angle == AngleUnit::Radians  ? QStringLiteral("rad")
                                           : QStringLiteral("pulse");
    case Unit::RevPerMin: return QStringLiteral("rev/min");
    case Unit::RevPerMin2: return QStringLiteral("rev/min²");
    case Unit::MilliAmpere: return QStringLiteral("mA");
    case Unit::Percent: return QStringLiteral("%");
    case Unit::Volt: return QStringLiteral("V");
    case Unit::Celsius: return QStringLiteral("°C");
    case Unit::Microsecond: return QStringLiteral("µs");
    case Unit::Millisecond: return QStringLiteral("ms");
    case Unit::MilliVoltPerMs: return QStringLiteral("mV/ms");
    }
    return {};
}

QString unitId(Unit unit)
{
    switch (unit) {
    case Unit::Pulse: return QStringLiteral("deg");
    case Unit::RevPerMin2: return QStringLiteral("rev/min2");
    case Unit::Celsius: return QStringLiteral("degC");
    case Unit::Microsecond: return QStringLiteral("us");
    default: return unitSymbol(unit);
    }
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
    const Field &field, const EffectiveField &effective, int resolution, std::int64_t raw, AngleUnit angle)
{
    const QString name = meaning(field, raw);
    if (!name.isEmpty())
        return name;
    if (effective.unit == Unit::None)
        return QString::number(raw);
    const Physical shown = physical(effective, resolution, raw, angle);
    return fixed(shown) + u' ' + shown.unit;
}

Result<void> checkRange(const Field &field, const EffectiveField &effective, std::int64_t raw)
{
    return checkRange(field, effective, raw, 1, AngleUnit::Pulses);
}

Result<void> checkRange(
    const Field &field, const EffectiveField &effective, std::int64_t raw, int resolution, AngleUnit angle)
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
    if (!unitSymbol(effective.unit, angle).isEmpty() && unitSymbol(effective.unit, angle) != u"pulse") {
        const Physical from = physical(effective, resolution, low, angle);
        const Physical to = physical(effective, resolution, high, angle);
        const Physical wanted = physical(effective, resolution, raw, angle);
        value += QStringLiteral(" (%1 %2)").arg(fixed(wanted), wanted.unit);
        range += QStringLiteral(" (%1 to %2 %3)").arg(fixed(from), fixed(to), to.unit);
    }
    return failure(
        ErrorKind::InvalidArgument, QStringLiteral("%1 can't be %2; its range is %3").arg(field.name, value, range));
}

} // namespace dynascope
