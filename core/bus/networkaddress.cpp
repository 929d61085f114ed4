// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"
#include "core/bus/networkaddress_values.h"
#include "core/protocol/protocol_values.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr QLatin1String RawScheme("tcp://");
constexpr QLatin1String Rfc2217Scheme("rfc2217://");
constexpr QLatin1String BaudQuery("?baud=");
constexpr qsizetype LongestHost = 253; ///< of a DNS name

/// Digits alone, within 1..highest; else 0.
int number(QStringView text, int highest)
{
    if (text.isEmpty() || text.size() > 9 || !std::ranges::all_of(text, [](QChar c) { return c >= u'0' && c <= u'9'; }))
        return 0;
    const int value = text.toInt();
    return value <= highest ? value : 0;
}

/// What a name or an address is made of; a zone ("%eth0") included.
bool isHost(QStringView host, bool bracketed)
{
    return !host.isEmpty() && host.size() <= LongestHost && std::ranges::all_of(host, [bracketed](QChar c) {
        const bool common = (c.isLetterOrNumber() && c.unicode() < 128) || c == u'.' || c == u'-' || c == u'_';
        return common || (bracketed && (c == u':' || c == u'%'));
    });
}

/// Splits "[::1]:4000" or "host:4000"; both empty where the form is wrong.
std::pair<QStringView, QStringView> hostAndPort(QStringView text)
{
    if (text.startsWith(u'[')) {
        const qsizetype end = text.indexOf(u']');
        if (end < 0 || !text.sliced(end + 1).startsWith(u':') || !isHost(text.sliced(1, end - 1), true))
            return {};
        return {text.sliced(1, end - 1), text.sliced(end + 2)};
    }
    const qsizetype colon = text.indexOf(u':');
    if (colon < 0 || text.indexOf(u':', colon + 1) >= 0 || !isHost(text.first(colon), false))
        return {};
    return {text.first(colon), text.sliced(colon + 1)};
}

} // namespace

bool NetworkAddress::isNetworkName(QStringView name)
{
    return name.startsWith(RawScheme, Qt::CaseInsensitive) || name.startsWith(Rfc2217Scheme, Qt::CaseInsensitive);
}

Result<NetworkAddress> NetworkAddress::parse(const QString &name)
{
    NetworkAddress address;
    const bool raw = name.startsWith(RawScheme, Qt::CaseInsensitive);
    if (!raw && !name.startsWith(Rfc2217Scheme, Qt::CaseInsensitive))
        return tl::unexpected(messages::addressMalformed(name));
    address.kind = raw ? Kind::Raw : Kind::Rfc2217;
    QStringView rest = QStringView(name).sliced(raw ? RawScheme.size() : Rfc2217Scheme.size());
    if (const qsizetype query = rest.indexOf(u'?'); raw && query >= 0) {
        address.serverBaud =
            rest.sliced(query).startsWith(BaudQuery) ? number(rest.sliced(query + BaudQuery.size()), HighestBaudRate) : 0;
        if (address.serverBaud == 0)
            return tl::unexpected(messages::addressMalformed(name));
        rest = rest.first(query);
    }
    const auto [host, port] = hostAndPort(rest);
    if (host.isEmpty())
        return tl::unexpected(messages::addressMalformed(name));
    address.host = host.toString();
    address.port = static_cast<quint16>(number(port, 65535));
    if (address.port == 0)
        return tl::unexpected(messages::portNumberWrong(name, port.toString()));
    return address;
}

bool isRateTheServers(QStringView name)
{
    return name.startsWith(RawScheme, Qt::CaseInsensitive);
}

} // namespace dynascope
