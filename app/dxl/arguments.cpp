// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/arguments.h"

#include "core/protocol/protocol_values.h"

#include <QRegularExpression>
#include <QStringList>

#include <optional>
#include <set>

namespace dynascope::dxl {

namespace {

constexpr int AddressSpace = 0x10000;
constexpr int LongestRegister = 1000; ///< bytes; more would not fit a packet with its stuffing

/// Decimal, or hexadecimal after 0x, with an optional sign.
std::optional<std::int64_t> number(const QString &text)
{
    const bool negative = text.startsWith(u'-');
    const QString digits = negative ? text.mid(1) : text;
    if (digits.isEmpty() || digits.startsWith(u'-') || digits.startsWith(u'+'))
        return std::nullopt;
    const bool hexadecimal = digits.startsWith(u"0x", Qt::CaseInsensitive);
    bool ok = false;
    const qint64 value = hexadecimal ? digits.mid(2).toLongLong(&ok, 16) : digits.toLongLong(&ok, 10);
    if (!ok)
        return std::nullopt;
    return negative ? -value : value;
}

} // namespace

tl::unexpected<Error> wrong(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, text);
}

QString RegisterArgument::text() const
{
    return isByAddress() ? QStringLiteral("%1:%2").arg(address).arg(length) : field;
}

Result<RegisterArgument> parseRegister(const QString &text)
{
    const qsizetype colon = text.indexOf(u':');
    if (colon < 0) {
        if (text.trimmed().isEmpty())
            return wrong(QStringLiteral("the name of a field is missing"));
        return RegisterArgument{text.trimmed(), 0, 0, {}};
    }
    const auto address = number(text.left(colon).trimmed());
    const auto length = number(text.mid(colon + 1).trimmed());
    if (!address || !length)
        return wrong(QStringLiteral("\"%1\" is neither a field nor ADDRESS:LENGTH").arg(text));
    if (*length < 1 || *length > LongestRegister)
        return wrong(QStringLiteral("\"%1\": a length is 1 to %2 bytes").arg(text).arg(LongestRegister));
    if (*address < 0 || *address >= AddressSpace)
        return wrong(QStringLiteral("\"%1\" lies outside of the addresses 0 to %2").arg(text).arg(AddressSpace - 1));
    if (*address + *length > AddressSpace)
        return wrong(QStringLiteral("\"%1\": %2 bytes from there on end behind the last address, %3")
                         .arg(text)
                         .arg(*length)
                         .arg(AddressSpace - 1));
    return RegisterArgument{{}, static_cast<int>(*address), static_cast<int>(*length), {}};
}

Result<RegisterArgument> parseAssignment(const QString &text)
{
    const qsizetype equals = text.indexOf(u'=');
    if (equals < 0)
        return wrong(QStringLiteral("\"%1\" says no value: FIELD=VALUE or ADDRESS:LENGTH=VALUE").arg(text));
    auto argument = parseRegister(text.left(equals));
    if (!argument)
        return argument;
    argument->value = text.mid(equals + 1).trimmed();
    if (argument->value.isEmpty())
        return wrong(QStringLiteral("\"%1\" says no value behind the =").arg(text));
    return argument;
}

Result<Bytes> parseRawValue(const RegisterArgument &argument)
{
    Bytes bytes;
    if (argument.length <= 4) {
        const auto value = number(argument.value);
        const std::int64_t end = std::int64_t(1) << (8 * argument.length);
        if (!value || *value >= end || *value < -end / 2) {
            return wrong(QStringLiteral("\"%1\" is not a number that fits %2: %3 to %4")
                             .arg(argument.value, argument.text()).arg(-end / 2).arg(end - 1));
        }
        appendLittleEndian(bytes, static_cast<std::uint32_t>(*value), argument.length);
        return bytes;
    }
    QString digits = argument.value;
    if (digits.startsWith(u"0x", Qt::CaseInsensitive))
        digits.remove(0, 2);
    digits.remove(u' ').remove(u':');
    static const QRegularExpression pairs(QStringLiteral("^([0-9a-fA-F]{2})+$"));
    if (!pairs.match(digits).hasMatch() || digits.size() != qsizetype(2) * argument.length) {
        return wrong(QStringLiteral("%1 takes %2 bytes as %3 hexadecimal digits, not \"%4\"")
                         .arg(argument.text()).arg(argument.length).arg(2 * argument.length).arg(argument.value));
    }
    for (const char byte : QByteArray::fromHex(digits.toLatin1()))
        bytes.push_back(static_cast<std::uint8_t>(byte));
    return bytes;
}

Result<std::vector<int>> parseBauds(const QString &text, const std::vector<int> &all)
{
    if (text.compare(u"all", Qt::CaseInsensitive) == 0)
        return all;
    std::vector<int> bauds;
    for (const QString &part : text.split(u',')) {
        bool ok = false;
        const int baud = part.trimmed().toInt(&ok);
        if (!ok || baud < LowestBaudRate || baud > HighestBaudRate) {
            return wrong(QStringLiteral("\"%1\" is not a baud rate in bits per second, %2 and more: "
                                        "57600,1000000 or all")
                             .arg(part)
                             .arg(LowestBaudRate));
        }
        bauds.push_back(baud);
    }
    return bauds;
}

Result<IdRange> parseIds(const QString &text)
{
    const QStringList parts = text.split(u'-');
    bool firstOk = false;
    bool lastOk = false;
    const IdRange range{parts.first().trimmed().toInt(&firstOk), parts.last().trimmed().toInt(&lastOk)};
    if (!firstOk || !lastOk || parts.size() > 2 || range.first < 0 || range.last > MaximumId || range.first > range.last)
        return wrong(QStringLiteral("\"%1\" is not a range of IDs within 0-%2").arg(text).arg(MaximumId));
    return range;
}

Result<std::vector<std::uint8_t>> parseIdList(const QString &text)
{
    std::set<std::uint8_t> ids;
    for (const QString &part : text.split(u',')) {
        const auto range = parseIds(part);
        if (!range)
            return tl::unexpected(range.error());
        for (int id = range->first; id <= range->last; ++id)
            ids.insert(static_cast<std::uint8_t>(id));
    }
    return std::vector<std::uint8_t>(ids.begin(), ids.end());
}

} // namespace dynascope::dxl
