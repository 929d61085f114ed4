// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/typedunits.h"
#include "core/table/units.h"

#include <cmath>

namespace dynascope {
namespace {

QString oneOf(const QStringList &names)
{
    return names.join(QStringLiteral(", "));
}

tl::unexpected<Error> refuse(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, text);
}

/// The unit under which TypedUnits has what may be typed for it.
Unit typedAs(Unit unit)
{
    return isAngle(unit) ? Unit::Pulse : unit == Unit::PulsePerMs ? Unit::PulsePerSec : unit;
}

bool hasTorque(const EffectiveField &field)
{
    return field.torqueConstant > 0 && (field.unit == Unit::MilliAmpere || field.unit == Unit::Ampere);
}

QString lowered(QStringView text)
{
    QString plain;
    for (QChar c : text) {
        if (c == u'\u03BC' || c == u'\u00B5') // the Greek letter and the micro sign
            c = u'u';
        if (!c.isSpace())
            plain.append(c.toLower());
    }
    return plain;
}

QString typableUnits(const EffectiveField &field)
{
    const Unit unit = typedAs(field.unit);
    QStringList offered;
    for (const TypedUnit &typed : TypedUnits) {
        if (typed.unit == unit && offered.size() < 3)
            offered.append(QString::fromUtf16(typed.text));
    }
    if (isAngle(field.unit))
        offered.append(QStringLiteral("pulse"));
    if (unit == Unit::PulsePerSec)
        offered.append(tableUnit(field.unit));
    if (hasTorque(field))
        offered.append(QStringLiteral("Nm"));
    return oneOf(offered);
}

/// A number at the beginning of a text, and what stands after it.
struct Leading {
    double value = 0;
    bool whole = false; ///< digits alone: `integer` holds
    std::int64_t integer = 0;
    QString text; ///< as typed, without what stands after it
    QString rest; ///< as typed
    QString unit; ///< the same, to be compared
};

/// Digits, a point, an exponent; nothing that a locale could change.
std::optional<Leading> leadingNumber(QStringView text)
{
    qsizetype at = 0;
    const auto digits = [&] {
        const qsizetype from = at;
        while (at < text.size() && text[at] >= u'0' && text[at] <= u'9')
            ++at;
        return at - from;
    };
    if (!text.isEmpty() && (text[0] == u'-' || text[0] == u'+'))
        ++at;
    qsizetype count = digits();
    Leading number;
    number.whole = count > 0;
    if (at < text.size() && text[at] == u'.') {
        ++at;
        count += digits();
        number.whole = false;
    }
    if (count == 0)
        return std::nullopt;
    if (at < text.size() && text[at].toLower() == u'e') {
        const qsizetype before = at++;
        if (at < text.size() && (text[at] == u'-' || text[at] == u'+'))
            ++at;
        if (digits() > 0)
            number.whole = false;
        else
            at = before;
    }
    bool ok = false;
    number.value = text.first(at).toDouble(&ok);
    if (!ok)
        return std::nullopt; // too large for a double
    if (text[0] == u'-')
        number.value = -std::abs(number.value); // −0 too: it may be another raw value
    if (number.whole)
        number.integer = text.first(at).toLongLong(&number.whole);
    number.text = text.first(at).toString();
    number.rest = text.sliced(at).trimmed().toString();
    number.unit = lowered(number.rest);
    return number;
}

std::optional<std::int64_t> hexadecimal(QStringView text)
{
    const bool negative = text.startsWith(u'-');
    if (negative)
        text = text.sliced(1);
    if (!text.startsWith(u"0x", Qt::CaseInsensitive))
        return std::nullopt;
    bool ok = false;
    const qulonglong value = text.sliced(2).toULongLong(&ok, 16);
    if (!ok || value > 0xFFFFFFFF || text[2] == u'+' || text[2] == u'-')
        return std::nullopt;
    const auto number = static_cast<std::int64_t>(value);
    return negative ? -number : number;
}

/// Refused where the other bits of a register whose direction is a bit have no room for it.
Result<std::int64_t> rawOf(const Field &field, const EffectiveField &effective, int resolution, const Leading &typed,
                           double value, const UnitPreferences &units)
{
    const std::int64_t raw = rawFromPhysical(effective, resolution, value, units);
    if (effective.directionBit < 0)
        return raw;
    const Physical most = physical(effective, resolution, (std::int64_t(1) << effective.directionBit) - 1, units);
    const Physical one = physical(effective, resolution, 1, units);
    if (std::abs(value) < most.value + one.value / 2)
        return raw;
    const QString end = QString::number(most.value, 'f', most.decimals);
    return refuse(QStringLiteral("%1 can't be %2 %3; its range is -%4 to %4 %5")
                      .arg(field.name, typed.text, typed.rest, end, most.unit));
}

Result<std::int64_t> fromUnit(
    const Field &field, const EffectiveField &effective, int resolution, const Leading &number)
{
    if (effective.unit == Unit::None)
        return refuse(QStringLiteral("%1 has no unit; give a bare number").arg(field.name));
    if (isAngle(effective.unit) && (number.unit == u"pulse" || number.unit == u"pulses"))
        return rawOf(field, effective, resolution, number, number.value, AngleUnit::Pulses);
    if (hasTorque(effective) && (number.unit == u"nm" || number.unit == u"n·m")) {
        UnitPreferences torque;
        torque.torque = true;
        return rawOf(field, effective, resolution, number, number.value, torque);
    }
    const Unit unit = typedAs(effective.unit);
    const bool isPerMs = number.unit == u"pulse/ms";
    if (unit == Unit::PulsePerSec && (isPerMs || number.unit == u"pulse/s")) {
        const bool wantsPerMs = effective.unit == Unit::PulsePerMs;
        const double own = isPerMs == wantsPerMs ? number.value : number.value * (isPerMs ? 1000.0 : 0.001);
        return rawOf(field, effective, resolution, number, own, AngleUnit::Pulses);
    }
    for (const TypedUnit &typed : TypedUnits) {
        if (typed.unit == unit && lowered(QString::fromUtf16(typed.text)) == number.unit)
            return rawOf(field, effective, resolution, number, number.value * typed.factor, {});
    }
    return refuse(QStringLiteral("\"%1\" does not fit %2; it takes %3, or a bare number for the register's own value")
                      .arg(number.rest, field.name, typableUnits(effective)));
}

/// The value whose name this is, or that alone begins so.
std::optional<std::int64_t> byName(
    const std::vector<EnumValue> &values, const QString &plain, std::optional<std::int64_t> preferred)
{
    const EnumValue *begins = nullptr;
    bool several = false;
    const EnumValue *exact = nullptr;
    for (const EnumValue &value : values) {
        const QString name = normalizedName(value.text);
        if (name == plain && (!exact || value.value == preferred))
            exact = &value;
        if (plain.size() >= 3 && name.startsWith(plain)) { // short enough to type, too long for an accident
            several = several || (begins && normalizedName(begins->text) != name);
            if (!begins || value.value == preferred)
                begins = &value;
        }
    }
    if (exact)
        return exact->value;
    return begins && !several ? std::optional(begins->value) : std::nullopt;
}

/// "on" and "off" for registers whose two values have other names.
std::optional<std::int64_t> asSwitch(const Field &field, const QString &plain)
{
    const bool isSwitch = field.values.size() == 2 && field.values[0].value == 0 && field.values[1].value == 1;
    if (!isSwitch)
        return std::nullopt;
    if (plain == u"on" || plain == u"true")
        return 1;
    if (plain == u"off" || plain == u"false")
        return 0;
    return std::nullopt;
}

std::optional<std::int64_t> bitByName(const Field &field, const QString &plain)
{
    for (const BitField &bit : field.bits) {
        if (bit.count == 1 && normalizedName(bit.name) == plain)
            return std::int64_t(1) << bit.first;
        if (bit.count > 1) {
            for (const EnumValue &value : bit.values) {
                if (normalizedName(value.text) == plain)
                    return value.value << bit.first;
            }
        }
    }
    if (plain.startsWith(u"bit")) {
        bool ok = false;
        const int number = QStringView(plain).sliced(3).toInt(&ok);
        if (ok && number >= 0 && number < 8 * field.size)
            return std::int64_t(1) << number;
    }
    return std::nullopt;
}

/// What may be typed instead of a number.
QStringList namesOf(const Field &field)
{
    QStringList names;
    for (const EnumValue &value : field.values)
        names.append(value.text);
    for (const EnumValue &value : field.special) {
        const bool settable = value.value >= field.minimum.number.value_or(value.value)
            && value.value <= field.maximum.number.value_or(value.value);
        if (settable && !names.contains(value.text))
            names.append(value.text);
    }
    for (const BitField &bit : field.bits) {
        if (bit.count == 1)
            names.append(bit.name);
        for (const EnumValue &value : bit.values) {
            if (bit.count > 1)
                names.append(value.text);
        }
    }
    if (!field.bits.empty())
        names.append(QStringLiteral("None"));
    return names;
}

Result<std::int64_t> fromBits(const Field &field, QStringView text)
{
    const QString whole = normalizedName(text);
    if (whole == u"none")
        return 0;
    std::int64_t raw = 0;
    QString joined = text.toString();
    joined.replace(u'+', u',');
    const QStringList parts = joined.split(u',');
    for (const QString &part : parts) {
        const std::optional<std::int64_t> bit = bitByName(field, normalizedName(part));
        if (!bit) {
            return refuse(QStringLiteral("\"%1\" is no bit of %2; it has %3, joined by + or ,")
                              .arg(part.trimmed(), field.name, oneOf(namesOf(field))));
        }
        raw |= *bit;
    }
    return raw;
}

Result<std::int64_t> fromName(const Field &field, const EffectiveField &effective, QStringView text)
{
    const QString plain = normalizedName(text);
    if (const auto value = byName(field.values, plain, field.initial))
        return *value;
    if (const auto value = asSwitch(field, plain))
        return *value;
    if (const auto value = byName(field.special, plain, field.initial))
        return *value;
    if (!field.bits.empty())
        return fromBits(field, text);
    const QStringList names = namesOf(field);
    if (!field.values.empty())
        return refuse(QStringLiteral("\"%1\" is no value of %2; it is one of %3").arg(text, field.name, oneOf(names)));
    QString takes = QStringLiteral("a number");
    if (effective.unit != Unit::None)
        takes += QStringLiteral(" by itself or with a unit (%1)").arg(typableUnits(effective));
    if (!names.isEmpty())
        takes += QStringLiteral(", or %1").arg(oneOf(names));
    return refuse(QStringLiteral("\"%1\" is no value of %2; it takes %3").arg(text, field.name, takes));
}

Result<std::int64_t> unchecked(const Field &field, const EffectiveField &effective, int resolution, QStringView text)
{
    if (const auto value = hexadecimal(text))
        return *value;
    // A bare number is always the raw value; names that begin with digits ("57600 bps") come before units.
    const std::optional<Leading> number = leadingNumber(text);
    if (!number)
        return fromName(field, effective, text);
    if (number->rest.isEmpty()) {
        if (number->whole)
            return number->integer;
        return refuse(effective.unit == Unit::None
                ? QStringLiteral("%1 takes a whole number, not %2").arg(field.name, text)
                : QStringLiteral("%1 takes a whole number, or any with a unit (%2), not %3")
                      .arg(field.name, typableUnits(effective), text));
    }
    if (!namesOf(field).isEmpty()) {
        const Result<std::int64_t> value = fromName(field, effective, text);
        if (value || effective.unit == Unit::None)
            return value;
    }
    return fromUnit(field, effective, resolution, *number);
}

} // namespace

Result<std::int64_t> parseValue(
    const Field &field, const EffectiveField &effective, int resolution, QStringView text, const UnitPreferences &units)
{
    QString trimmed = text.trimmed().toString();
    trimmed.replace(u'\u2212', u'-'); // the typographic minus, as it comes from copied text
    if (trimmed.isEmpty())
        return refuse(QStringLiteral("%1 needs a value").arg(field.name));
    const Result<std::int64_t> raw = unchecked(field, effective, resolution, trimmed);
    if (!raw)
        return raw;
    const Result<void> inRange = checkRange(field, effective, *raw, resolution, units);
    if (!inRange)
        return tl::unexpected<Error>(inRange.error());
    return raw;
}

} // namespace dynascope
