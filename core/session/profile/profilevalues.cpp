// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilevalues.h"

#include <algorithm>

namespace dynascope {
namespace {

/// Does it decide in which unit the field is?
bool decidesUnit(const Field &field, QStringView name)
{
    const QString plain = normalizedName(name);
    const bool isAlternate = std::ranges::any_of(
        field.alternates, [&](const Alternate &alternate) { return normalizedName(alternate.reg) == plain; });
    return isAlternate || name == field.gearRatio.numerator || name == field.gearRatio.denominator;
}

std::optional<std::int64_t> wantedOf(const ControlTable &table, const std::vector<WantedValue> &wanted,
                                     QStringView name)
{
    const Field *field = table.find(name);
    for (const WantedValue &each : wanted) {
        if (field && each.field == field)
            return each.raw ? std::optional(*each.raw) : std::nullopt;
    }
    return std::nullopt;
}

/// A bare number, which is the raw value.
bool isRaw(QStringView text)
{
    const QStringView trimmed = text.trimmed();
    if (trimmed.contains(u"0x", Qt::CaseInsensitive))
        return true;
    return !trimmed.isEmpty() && std::ranges::all_of(trimmed, [](QChar c) {
        return (c >= u'0' && c <= u'9') || c == u'-' || c == u'+' || c == u'\u2212';
    });
}

UnitPreferences unitsLike(QStringView text)
{
    UnitPreferences units;
    const QString plain = text.toString().toLower();
    if (plain.endsWith(u"rad"))
        units.angle = AngleUnit::Radians;
    else if (plain.endsWith(u"turn") || plain.endsWith(u"turns") || plain.endsWith(u"rev"))
        units.angle = AngleUnit::Turns;
    else if (plain.endsWith(u"pulse") || plain.endsWith(u"pulses"))
        units.angle = AngleUnit::Pulses;
    units.torque = plain.endsWith(u"nm");
    return units;
}

/// As it is typed: "180 deg", "0.229 rev/min".
QString typed(const EffectiveField &field, int resolution, std::int64_t raw, const UnitPreferences &units)
{
    const Physical shown = physical(field, resolution, raw, units);
    QString number = QString::number(shown.value, 'f', shown.decimals);
    if (number.contains(u'.')) {
        while (number.endsWith(u'0'))
            number.chop(1);
        if (number.endsWith(u'.'))
            number.chop(1);
    }
    const bool isOwnUnit = !units.torque && !(isAngle(field.unit) && units.angle != AngleUnit::Degrees);
    return number + u' ' + (isOwnUnit ? unitId(field.unit) : shown.unit);
}

} // namespace

QStringList deciders(const Field &field)
{
    QStringList names{field.minimum.reg, field.maximum.reg, field.gearRatio.numerator, field.gearRatio.denominator};
    for (const Alternate &alternate : field.alternates)
        names << alternate.reg << alternate.minimum.reg << alternate.maximum.reg;
    names.removeAll(QString());
    names.removeDuplicates();
    return names;
}

ProfileValue profileValue(const ControlTable &table, const Field &field, std::int64_t raw, const RegisterLookup &lookup)
{
    const EffectiveField units = effective(field, lookup);
    const bool isBare = units.unit == Unit::None && units.scale == 1.0;
    return {raw, isBare ? static_cast<double>(raw) : physical(units, table.resolution(), raw).value, unitId(units.unit),
            valueText(field, units, table.resolution(), raw)};
}

std::vector<WantedValue> wantedValues(const ProfileJoint &joint, const ControlTable &table, const RegisterLookup &held)
{
    std::vector<WantedValue> wanted(joint.registers.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i].field = table.find(joint.registers[i].name);
        wanted[i].raw = failure(ErrorKind::NotFound, QString());
    }
    // First those whose meaning hangs on no other; a unit is only ever decided by such a one.
    const RegisterLookup after = lookupAfter(table, wanted, held);
    for (const bool isDecided : {false, true}) {
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const Field *field = wanted[i].field;
            if (!field || (!field->alternates.empty() || field->gearRatio.isSet()) != isDecided)
                continue;
            const RegisterLookup units = [&](QStringView name) -> std::optional<std::int64_t> {
                return decidesUnit(*field, name) ? after(name) : std::nullopt;
            };
            wanted[i].raw = parseValue(*field, effective(*field, units), table.resolution(), joint.registers[i].text);
        }
    }
    // Then the limits, among them those that the profile itself sets.
    std::vector<WantedValue> checked = wanted;
    for (WantedValue &each : checked) {
        if (!each.field || !each.raw)
            continue;
        const Result<void> inRange =
            checkRange(*each.field, effective(*each.field, after), *each.raw, table.resolution());
        if (!inRange)
            each.raw = tl::unexpected(inRange.error());
    }
    return checked;
}

RegisterLookup lookupAfter(const ControlTable &table, const std::vector<WantedValue> &wanted,
                           const RegisterLookup &held)
{
    return [&table, &wanted, &held](QStringView name) -> std::optional<std::int64_t> {
        if (const auto value = wantedOf(table, wanted, name))
            return value;
        return held ? held(name) : std::nullopt;
    };
}

QString textOfValue(const ControlTable &table, const Field &field, std::int64_t raw, const RegisterLookup &lookup,
                    QStringView like)
{
    const QString number = QString::number(raw);
    if (isRaw(like))
        return number;
    const EffectiveField units = effective(field, lookup);
    const int resolution = table.resolution();
    const auto means = [&](const QString &text) {
        const auto value = parseValue(field, units, resolution, text);
        return value && *value == raw;
    };
    if (const QString name = meaning(field, raw); !name.isEmpty() && means(name))
        return name;
    if (units.unit == Unit::None)
        return number;
    for (const UnitPreferences &preferred : {unitsLike(like), UnitPreferences()}) {
        if (const QString text = typed(units, resolution, raw, preferred); means(text))
            return text;
    }
    return number;
}

} // namespace dynascope
