// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/fieldreader.h"

#include "core/table/controltable.h"

#include <QJsonArray>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr int LongestLabel = 80;
constexpr int LongestHelp = 600;

struct UnitName {
    const char16_t *name;
    Unit unit;
};

constexpr UnitName UnitNames[] = {
    {u"pulse", Unit::Pulse},
    {u"rev/min", Unit::RevPerMin},
    {u"rev/min2", Unit::RevPerMin2},
    {u"mA", Unit::MilliAmpere},
    {u"%", Unit::Percent},
    {u"V", Unit::Volt},
    {u"degC", Unit::Celsius},
    {u"us", Unit::Microsecond},
    {u"ms", Unit::Millisecond},
    {u"mV/ms", Unit::MilliVoltPerMs},
};

std::int64_t bitMask(const BitField &bit)
{
    return ((std::int64_t(1) << bit.count) - 1) << bit.first;
}

/// The lowest bit and how many, of {"bit": 2} or {"bits": [4, 5]}.
std::optional<std::pair<int, int>> bitPlace(const QJsonObject &json, int width)
{
    std::optional<std::int64_t> first = wholeNumber(json.value(u"bit"));
    std::optional<std::int64_t> last = first;
    const QJsonValue group = json.value(u"bits");
    if (group.isUndefined() == json.value(u"bit").isUndefined())
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

std::optional<std::int64_t> wholeNumber(const QJsonValue &value)
{
    constexpr double Exact = 9007199254740992.0; // 2^53
    const double number = value.toDouble(0.5);
    if (!value.isDouble() || std::abs(number) > Exact || number != std::floor(number))
        return std::nullopt;
    return static_cast<std::int64_t>(number);
}

bool holdsFor(const QJsonObject &json, int firmware)
{
    const QJsonValue since = json.value(u"since");
    const QJsonValue until = json.value(u"until");
    return since.toInt(0) <= firmware && firmware <= until.toInt(NewestFirmware);
}

Field FieldReader::read(const QString &name, const QJsonObject &json)
{
    m_field = Field();
    m_field.name = name;
    if (name.trimmed() != name || normalizedName(name).isEmpty() || name.size() > LongestLabel)
        say(QStringLiteral("not a name for a register"));
    readPlace(json);
    if (!m_wrong.isEmpty())
        return m_field; // without a size nothing else makes sense
    readValues(json.value(u"values"));
    m_field.special = readNamed(json.value(u"special"), false);
    readBits(json.value(u"bits").toObject());
    readRange(json.value(u"range"), m_field.minimum, m_field.maximum);
    readInitial(json.value(u"initial"));
    readUnit(json, m_field.unit, m_field.scale);
    readAlternates(json.value(u"alternates"));
    readTexts(json);
    return m_field;
}

void FieldReader::readPlace(const QJsonObject &json)
{
    const std::optional<std::int64_t> address = wholeNumber(json.value(u"address"));
    const std::optional<std::int64_t> size = wholeNumber(json.value(u"size"));
    if (!size || (*size != 1 && *size != 2 && *size != 4))
        return say(QStringLiteral("\"size\" must be 1, 2 or 4"));
    if (!address || *address < 0 || *address + *size > 65536)
        return say(QStringLiteral("\"address\" must be a number from 0 to %1").arg(65536 - *size));
    m_field.address = static_cast<std::uint16_t>(*address);
    m_field.size = static_cast<std::uint8_t>(*size);

    const QJsonValue isSigned = json.value(u"signed");
    if (!isSigned.isUndefined() && !isSigned.isBool())
        say(QStringLiteral("\"signed\" must be true or false"));
    m_field.isSigned = isSigned.toBool();

    const QString area = json.value(u"area").toString();
    if (area != u"EEPROM" && area != u"RAM" && area != u"HYBRID")
        say(QStringLiteral("\"area\" must be \"EEPROM\", \"RAM\" or \"HYBRID\""));
    m_field.area = area == u"EEPROM" ? Area::Eeprom : area == u"RAM" ? Area::Ram : Area::Hybrid;

    const QString access = json.value(u"access").toString();
    if (access != u"R" && access != u"RW")
        say(QStringLiteral("\"access\" must be \"R\" or \"RW\""));
    m_field.access = access == u"RW" ? Access::ReadWrite : Access::Read;
}

void FieldReader::readInitial(const QJsonValue &value)
{
    if (value.isUndefined())
        return;
    m_field.initial = value.toString() == u"model number" ? m_context.modelNumber : wholeNumber(value);
    if (!m_field.initial)
        return say(QStringLiteral("\"initial\" must be a whole number or \"model number\""));
    checkFits(*m_field.initial, QStringLiteral("initial value"));
    if (*m_field.initial < m_field.minimum.number.value_or(*m_field.initial)
        || *m_field.initial > m_field.maximum.number.value_or(*m_field.initial))
        say(QStringLiteral("initial value %1 lies outside the range").arg(*m_field.initial));
}

void FieldReader::readRange(const QJsonValue &value, Bound &minimum, Bound &maximum)
{
    if (value.isUndefined())
        return;
    if (value.toString() == u"values" && !m_field.values.empty()) {
        minimum.number = m_field.values.front().value;
        maximum.number = m_field.values.back().value;
        return;
    }
    if (value.toString() == u"bits" && !m_field.bits.empty()) {
        std::int64_t all = 0;
        for (const BitField &bit : m_field.bits)
            all |= bitMask(bit);
        minimum.number = 0;
        maximum.number = all;
        return;
    }
    const QJsonArray both = value.toArray();
    if (both.size() != 2) {
        return say(QStringLiteral("\"range\" must be [minimum, maximum], or \"values\" or \"bits\" of a register that "
                                  "has them"));
    }
    minimum = readBound(both[0]);
    maximum = readBound(both[1]);
    if (minimum.number && maximum.number && *minimum.number > *maximum.number)
        say(QStringLiteral("range %1 to %2 is upside down").arg(*minimum.number).arg(*maximum.number));
}

Bound FieldReader::readBound(const QJsonValue &value)
{
    Bound bound;
    if (value.isString() && !value.toString().isEmpty()) {
        const QString text = value.toString();
        bound.negated = text.startsWith(u'-');
        bound.reg = bound.negated ? text.mid(1) : text;
        return bound;
    }
    bound.number = wholeNumber(value);
    if (!bound.number)
        say(QStringLiteral("a limit must be a whole number or the name of a register"));
    else
        checkFits(*bound.number, QStringLiteral("limit"));
    return bound;
}

void FieldReader::readUnit(const QJsonObject &json, Unit &unit, double &scale)
{
    const QJsonValue name = json.value(u"unit");
    const QJsonValue factor = json.value(u"scale");
    if (!name.isUndefined()) {
        const QString text = name.toString();
        const auto known = std::find_if(std::begin(UnitNames), std::end(UnitNames),
            [&](const UnitName &candidate) { return text == QStringView(candidate.name); });
        if (known == std::end(UnitNames))
            return say(QStringLiteral("unknown unit \"%1\"").arg(text));
        unit = known->unit;
        scale = 1.0;
    }
    if (factor.isUndefined())
        return;
    if (name.isUndefined())
        say(QStringLiteral("\"scale\" without \"unit\""));
    scale = factor.toDouble();
    if (!(scale >= 1e-9 && scale <= 1e9))
        say(QStringLiteral("\"scale\" must be a number above 0"));
}

void FieldReader::readValues(const QJsonValue &value)
{
    if (!value.isString()) {
        m_field.values = readNamed(value, true);
        return;
    }
    if (value.toString() != u"baud rates")
        return say(QStringLiteral("\"values\" must be an object or \"baud rates\""));
    QJsonObject texts;
    for (auto it = m_context.baudRates.begin(); it != m_context.baudRates.end(); ++it)
        texts.insert(it.key(), QStringLiteral("%1 bps").arg(it->toInt()));
    m_field.values = readNamed(texts, true);
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
        const QString text = it->isObject() ? object.value(u"text").toString() : it->toString();
        checkLabel(text);
        if (distinct && names.contains(normalizedName(text)))
            say(QStringLiteral("two values are called \"%1\"").arg(text));
        names.append(normalizedName(text));
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
    bit.values = readNamed(json.value(u"values"), true);
    for (const EnumValue &value : bit.values) {
        if (value.value < 0 || value.value >> bit.count != 0)
            say(QStringLiteral("value %1 doesn't fit \"%2\"").arg(value.value).arg(name));
    }
    for (const BitField &other : m_field.bits) {
        if (bitMask(other) & bitMask(bit))
            say(QStringLiteral("\"%1\" and \"%2\" overlap").arg(other.name, name));
        if (normalizedName(other.name) == normalizedName(name))
            say(QStringLiteral("two bits are called \"%1\"").arg(name));
    }
    m_field.bits.push_back(bit);
}

void FieldReader::readAlternates(const QJsonValue &value)
{
    for (const QJsonValue &entry : value.toArray()) {
        if (const std::optional<Alternate> alternate = readAlternate(entry.toObject()))
            m_field.alternates.push_back(*alternate);
    }
}

std::optional<Alternate> FieldReader::readAlternate(const QJsonObject &json)
{
    Alternate alternate;
    alternate.reg = json.value(u"register").toString();
    alternate.minimum = m_field.minimum;
    alternate.maximum = m_field.maximum;
    alternate.unit = m_field.unit;
    alternate.scale = m_field.scale;
    readRange(json.value(u"range"), alternate.minimum, alternate.maximum);
    readUnit(json, alternate.unit, alternate.scale);

    const QJsonValue decider = m_context.registers.value(alternate.reg);
    const bool byBit = json.contains(u"bit");
    if (!decider.isObject() || byBit == json.contains(u"values")) {
        say(QStringLiteral("an alternate needs \"register\", one of this table, and either \"bit\" or \"values\""));
        return std::nullopt;
    }
    const bool applies = byBit ? resolveBit(decider.toObject(), json.value(u"bit").toString(), alternate)
                               : resolveValues(decider.toObject(), json.value(u"values").toArray(), alternate);
    // An alternate exists only where the register that decides does.
    return applies && holdsFor(decider.toObject(), m_context.firmware) ? std::optional(alternate) : std::nullopt;
}

bool FieldReader::resolveBit(const QJsonObject &decider, const QString &bit, Alternate &alternate)
{
    const QJsonObject json = decider.value(u"bits").toObject().value(bit).toObject();
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
    const QJsonObject possible = decider.value(u"values").toObject();
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

void FieldReader::readTexts(const QJsonObject &json)
{
    m_field.help = json.value(u"help").toString();
    if (m_field.help.isEmpty() || m_field.help.size() > LongestHelp)
        say(QStringLiteral("\"help\" must be a text of at most %1 characters").arg(LongestHelp));
    const QJsonValue resets = json.value(u"resets");
    if (!resets.isUndefined() && !resets.isArray())
        say(QStringLiteral("\"resets\" must be a list of registers"));
    for (const QJsonValue &name : resets.toArray())
        m_field.resets.append(name.toString());
}

void FieldReader::checkFits(std::int64_t number, const QString &what)
{
    if (number < smallestRaw(m_field) || number > largestRaw(m_field)) {
        say(QStringLiteral("%1 %2 doesn't fit %3 %4 byte(s)")
                .arg(what)
                .arg(number)
                .arg(m_field.isSigned ? QStringLiteral("signed") : QStringLiteral("unsigned"))
                .arg(m_field.size));
    }
}

void FieldReader::checkLabel(const QString &text)
{
    // '+' and ',' join bits where a person types them.
    if (normalizedName(text).isEmpty() || text.size() > LongestLabel || text.contains(u'+') || text.contains(u','))
        say(QStringLiteral("\"%1\" is not a name: 1 to %2 characters, no + and no comma").arg(text).arg(LongestLabel));
}

void FieldReader::say(const QString &what)
{
    if (m_wrong.isEmpty())
        m_wrong = m_field.name + QStringLiteral(": ") + what;
}

} // namespace dynascope
