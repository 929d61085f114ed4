// SPDX-License-Identifier: GPL-3.0-or-later
// Names of values and bits, and what changes with other registers (FORMAT.md, "Registers").
#include "core/table/fieldreader.h"

#include "core/table/controltable.h"

#include <QJsonArray>

#include <algorithm>

using namespace Qt::StringLiterals; // keys of JSON are found quicker by them

namespace dynascope {
namespace {

/// The lowest bit and how many, of {"bit": 2} or {"bits": [4, 5]}.
std::optional<std::pair<int, int>> bitPlace(const QJsonObject &json, int width)
{
    std::optional<std::int64_t> first = wholeNumber(json.value("bit"_L1));
    std::optional<std::int64_t> last = first;
    const QJsonValue group = json.value("bits"_L1);
    if (group.isUndefined() == json.value("bit"_L1).isUndefined())
        return std::nullopt;
    if (!group.isUndefined()) {
        const QJsonArray both = group.toArray();
        first = both.size() == 2 ? wholeNumber(both[0]) : std::nullopt;
        last = both.size() == 2 ? wholeNumber(both[1]) : std::nullopt;
    }
    if (!first || !last || *first < 0 || *last < *first || *last >= width)
        return std::nullopt;
    return std::pair(static_cast<int>(*first), static_cast<int>(*last - *first + 1));
}

} // namespace

/// Values by their texts; where a list is named instead, that.
QJsonValue FieldReader::listed(const QJsonValue &value)
{
    if (!value.isString())
        return value;
    if (value.toString() != u"baud rates") {
        const QJsonValue list = m_context.valueLists.value(value.toString());
        if (list.isUndefined())
            say(QStringLiteral("\"%1\" must be an object, \"baud rates\" or one of \"valueLists\"").arg(m_reading));
        return list;
    }
    QJsonObject texts;
    for (auto it = m_context.baudRates.begin(); it != m_context.baudRates.end(); ++it)
        texts.insert(it.key(), QStringLiteral("%1 bps").arg(it->toInt()));
    return texts;
}

std::vector<EnumValue> FieldReader::readNamed(const QJsonValue &value, bool distinct)
{
    std::vector<EnumValue> values;
    const QJsonObject all = value.toObject();
    QStringList names;
    for (auto it = all.begin(); it != all.end(); ++it) {
        const QJsonObject object = it->toObject();
        if (it->isObject() && !holdsFor(object, m_context.firmware))
            continue;
        bool isNumber = false;
        const std::int64_t number = it.key().toLongLong(&isNumber);
        if (!isNumber || QString::number(number) != it.key())
            say(QStringLiteral("\"%1\" is not a whole number").arg(it.key()));
        checkFits(number, QStringLiteral("value"));
        const QString text = it->isObject() ? object.value("text"_L1).toString() : it->toString();
        checkLabel(text);
        if (distinct && !m_context.isKnownSound) {
            if (names.contains(normalizedName(text)))
                say(QStringLiteral("two values are called \"%1\"").arg(text));
            names.append(normalizedName(text));
        }
        values.push_back({number, text});
    }
    std::sort(values.begin(), values.end(), [](const EnumValue &a, const EnumValue &b) { return a.value < b.value; });
    return values;
}

void FieldReader::readBits(const QJsonObject &json)
{
    for (auto it = json.begin(); it != json.end(); ++it) {
        if (!it->isObject())
            return say(QStringLiteral("bit \"%1\" must be an object").arg(it.key()));
        if (holdsFor(it->toObject(), m_context.firmware))
            readBit(it.key(), it->toObject());
    }
    if (!m_field.bits.empty() && !m_field.values.empty())
        say(QStringLiteral("has values and bits; it can only have one of them"));
    std::sort(m_field.bits.begin(), m_field.bits.end(),
              [](const BitField &a, const BitField &b) { return a.first < b.first; });
}

void FieldReader::readBit(const QString &name, const QJsonObject &json)
{
    const auto place = bitPlace(json, 8 * m_field.size);
    if (!place)
        return say(QStringLiteral("\"%1\" needs \"bit\": n or \"bits\": [first, last] within the register").arg(name));
    BitField bit;
    bit.first = place->first;
    bit.count = place->second;
    bit.name = name;
    checkLabel(name);
    bit.values = readNamed(json.value("values"_L1), true);
    for (const EnumValue &value : bit.values) {
        if (value.value < 0 || value.value >> bit.count != 0)
            say(QStringLiteral("value %1 doesn't fit \"%2\"").arg(value.value).arg(name));
    }
    for (const BitField &other : m_field.bits) {
        if (other.mask() & bit.mask())
            say(QStringLiteral("\"%1\" and \"%2\" overlap").arg(other.name, name));
        if (!m_context.isKnownSound && normalizedName(other.name) == normalizedName(name))
            say(QStringLiteral("two bits are called \"%1\"").arg(name));
    }
    m_field.bits.push_back(std::move(bit));
}

void FieldReader::readAlternates(const QJsonValue &value)
{
    for (const QJsonValue &entry : value.toArray()) {
        ++m_alternate;
        if (std::optional<Alternate> alternate = readAlternate(entry.toObject()))
            m_field.alternates.push_back(std::move(*alternate));
    }
    m_alternate = -1;
}

std::optional<Alternate> FieldReader::readAlternate(const QJsonObject &json)
{
    Alternate alternate;
    alternate.reg = json.value("register"_L1).toString();
    alternate.minimum = m_field.minimum;
    alternate.maximum = m_field.maximum;
    alternate.unit = m_field.unit;
    alternate.scale = m_field.scale;
    alternate.directionBit = m_field.directionBit;
    m_reading = QStringLiteral("range");
    readRange(json.value("range"_L1), alternate.minimum, alternate.maximum);
    readUnit(json, alternate.unit, alternate.scale);
    readDirectionBit(json.value("directionBit"_L1), alternate.directionBit);
    m_reading = QStringLiteral("register");

    const QJsonValue decider = m_context.registers.value(alternate.reg);
    const bool byBit = json.contains("bit"_L1);
    if (!decider.isObject() || byBit == json.contains("values"_L1)) {
        say(QStringLiteral("an alternate needs \"register\", one of this table, and either \"bit\" or \"values\""));
        return std::nullopt;
    }
    const bool applies = byBit ? resolveBit(decider.toObject(), json.value("bit"_L1).toString(), alternate)
                               : resolveValues(decider.toObject(), json.value("values"_L1).toArray(), alternate);
    // An alternate exists only where the register that decides does.
    return applies && holdsFor(decider.toObject(), m_context.firmware) ? std::optional(alternate) : std::nullopt;
}

bool FieldReader::resolveBit(const QJsonObject &decider, const QString &bit, Alternate &alternate)
{
    const QJsonObject json = decider.value("bits"_L1).toObject().value(bit).toObject();
    const auto place = bitPlace(json, 32);
    if (!place || place->second != 1) {
        say(QStringLiteral("%1 has no single bit \"%2\"").arg(alternate.reg, bit));
        return false;
    }
    alternate.mask = std::uint32_t(1) << place->first;
    alternate.values = {static_cast<std::int64_t>(alternate.mask)};
    return holdsFor(json, m_context.firmware);
}

bool FieldReader::resolveValues(const QJsonObject &decider, const QJsonArray &values, Alternate &alternate)
{
    // Families extend each other: what this model's register can't be is left out, but not everything.
    const QJsonObject possible = decider.value("values"_L1).toObject();
    for (const QJsonValue &value : values) {
        const std::optional<std::int64_t> number = wholeNumber(value);
        if (!number)
            say(QStringLiteral("\"values\" of an alternate must be whole numbers"));
        else if (possible.isEmpty() || possible.contains(QString::number(*number)))
            alternate.values.push_back(*number);
    }
    if (alternate.values.empty())
        say(QStringLiteral("%1 has none of the values of an alternate").arg(alternate.reg));
    return !alternate.values.empty();
}

} // namespace dynascope
