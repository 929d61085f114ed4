// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/fieldreader.h"

#include "core/table/controltable.h"
#include "core/table/units.h"

#include <QJsonArray>

#include <algorithm>
#include <cmath>

using namespace Qt::StringLiterals; // keys of JSON are found quicker by them

namespace dynascope {
namespace {

constexpr int LongestLabel = 80;
constexpr int LongestHelp = 600;

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
    const QJsonValue since = json.value("since"_L1);
    const QJsonValue until = json.value("until"_L1);
    return since.toInt(0) <= firmware && firmware <= until.toInt(NewestFirmware);
}

Field FieldReader::read(const QString &name, const QJsonObject &json)
{
    m_field = Field();
    m_field.name = name;
    if (!m_context.isKnownSound
        && (name.trimmed() != name || normalizedName(name).isEmpty() || name.size() > LongestLabel))
        say(QStringLiteral("not a name for a register"));
    readPlace(json);
    if (!m_wrong.isEmpty())
        return std::move(m_field); // without a size nothing else makes sense
    if (!m_context.addressesOnly)
        readMeaning(json);
    readTexts(json);
    return std::move(m_field);
}

void FieldReader::readMeaning(const QJsonObject &json)
{
    m_reading = QStringLiteral("values");
    m_field.values = readNamed(listed(json.value("values"_L1)), true);
    m_reading = QStringLiteral("special");
    m_field.special = readNamed(listed(json.value("special"_L1)), false);
    m_reading = QStringLiteral("bits");
    readBits(json.value("bits"_L1).toObject());
    m_reading = QStringLiteral("range");
    readRange(json.value("range"_L1), m_field.minimum, m_field.maximum);
    m_reading = QStringLiteral("initial");
    readInitial(json.value("initial"_L1));
    readUnit(json, m_field.unit, m_field.scale);
    readDirectionBit(json.value("directionBit"_L1), m_field.directionBit);
    readAlternates(json.value("alternates"_L1));
    if (m_field.unit == Unit::Pulse || m_field.unit == Unit::PulsePerSec || m_field.unit == Unit::PulsePerMs)
        m_field.gearRatio = m_context.gearRatio;
    if (m_field.unit == Unit::MilliAmpere || m_field.unit == Unit::Ampere)
        m_field.torqueConstant = m_context.torqueConstant;
}

void FieldReader::readPlace(const QJsonObject &json)
{
    const std::optional<std::int64_t> address = wholeNumber(json.value("address"_L1));
    const std::optional<std::int64_t> size = wholeNumber(json.value("size"_L1));
    m_reading = QStringLiteral("size");
    if (!json.contains("size"_L1))
        return say(QStringLiteral("\"size\" is missing, and what the file extends defines no register of this name"));
    if (size != 1 && size != 2 && size != 4)
        return say(QStringLiteral("\"size\" must be 1, 2 or 4"));
    m_reading = QStringLiteral("address");
    if (!address || *address < 0 || *address + *size > 0x10000)
        return say(QStringLiteral("\"address\" must be a number from 0 to %1").arg(0x10000 - *size));
    m_field.address = static_cast<std::uint16_t>(*address);
    m_field.size = static_cast<std::uint8_t>(*size);
    if (m_context.addressesOnly) {
        m_field.area = Area::Unknown;
        m_field.access = Access::Unknown;
        return;
    }
    const QJsonValue isSigned = json.value("signed"_L1);
    m_reading = QStringLiteral("signed");
    if (!isSigned.isUndefined() && !isSigned.isBool())
        say(QStringLiteral("\"signed\" must be true or false"));
    m_field.isSigned = isSigned.toBool();
    const QString area = json.value("area"_L1).toString(), access = json.value("access"_L1).toString();
    m_reading = QStringLiteral("area");
    m_field.area = area == u"EEPROM"   ? Area::Eeprom
                   : area == u"RAM"    ? Area::Ram
                   : area == u"HYBRID" ? Area::Hybrid
                                       : Area::Unknown;
    if (m_field.area == Area::Unknown && json.contains("area"_L1))
        say(QStringLiteral("\"area\" must be \"EEPROM\", \"RAM\" or \"HYBRID\""));
    m_reading = QStringLiteral("access");
    m_field.access = access == u"RW" ? Access::ReadWrite : access == u"R" ? Access::Read : Access::Unknown;
    if (m_field.access == Access::Unknown && json.contains("access"_L1))
        say(QStringLiteral("\"access\" must be \"R\" or \"RW\""));
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
            all |= bit.mask();
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
    const QJsonValue name = json.value("unit"_L1);
    const QJsonValue factor = json.value("scale"_L1);
    m_reading = QStringLiteral("unit");
    if (!name.isUndefined()) {
        const QString text = name.toString();
        const std::optional<Unit> known = unitFromTable(text);
        if (!known)
            return say(QStringLiteral("unknown unit \"%1\"").arg(text));
        unit = *known;
        scale = 1.0;
    }
    if (factor.isUndefined())
        return;
    m_reading = QStringLiteral("scale");
    if (name.isUndefined())
        say(QStringLiteral("\"scale\" without \"unit\""));
    readScale(factor, scale);
}

void FieldReader::readScale(const QJsonValue &value, double &scale)
{
    const QJsonValue number = value.isString() ? m_context.scales.value(value.toString()) : value;
    if (number.isUndefined())
        say(QStringLiteral("\"scales\" has no \"%1\"").arg(value.toString()));
    scale = number.toDouble();
    if (!(scale >= 1e-9 && scale <= 1e9))
        say(QStringLiteral("\"scale\" must be a number above 0, or the name of one of \"scales\""));
}

void FieldReader::readDirectionBit(const QJsonValue &value, int &bit)
{
    if (value.isUndefined())
        return;
    m_reading = QStringLiteral("directionBit");
    const std::int64_t number = wholeNumber(value).value_or(-1);
    if (number < 1 || number >= 8 * m_field.size || m_field.isSigned)
        return say(QStringLiteral("\"directionBit\" must be a bit above the lowest of an unsigned register"));
    bit = static_cast<int>(number);
}

void FieldReader::readTexts(const QJsonObject &json)
{
    m_reading = QStringLiteral("help");
    m_field.help = readText(json, QStringLiteral("help"));
    m_reading = QStringLiteral("doubt");
    m_field.doubt = readText(json, QStringLiteral("doubt"));
    m_reading = QStringLiteral("needs");
    const QJsonValue needs = json.value("needs"_L1);
    m_field.torqueOff = needs == QLatin1String("torque off");
    if (!needs.isUndefined() && !m_field.torqueOff)
        say(QStringLiteral("\"needs\" must be \"torque off\""));
    m_reading = QStringLiteral("resets");
    const QJsonValue resets = json.value("resets"_L1);
    if (!resets.isUndefined() && !resets.isArray())
        say(QStringLiteral("\"resets\" must be a list of registers"));
    for (const QJsonValue &name : m_context.addressesOnly ? QJsonArray() : resets.toArray())
        m_field.resets.append(name.toString());
}

QString FieldReader::readText(const QJsonObject &json, const QString &key)
{
    const QJsonValue value = json.value(key);
    const QString text = value.toString();
    if (!value.isUndefined() && (text.isEmpty() || text.size() > LongestHelp))
        say(QStringLiteral("\"%1\" must be a text of at most %2 characters").arg(key).arg(LongestHelp));
    return text;
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
    if (m_context.isKnownSound)
        return;
    // '+' and ',' join bits where a person types them.
    if (normalizedName(text).isEmpty() || text.size() > LongestLabel || text.contains(u'+') || text.contains(u','))
        say(QStringLiteral("\"%1\" is not a name: 1 to %2 characters, no + and no comma").arg(text).arg(LongestLabel));
}

void FieldReader::say(const QString &what)
{
    if (!m_wrong.isEmpty())
        return;
    m_wrong = m_field.name + QStringLiteral(": ") + what;
    m_wrongPath = {m_reading};
    if (m_alternate >= 0)
        m_wrongPath = QStringList{QStringLiteral("alternates"), QString::number(m_alternate), m_reading};
}

} // namespace dynascope
