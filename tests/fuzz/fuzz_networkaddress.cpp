// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as the name of a serial server: refused with a reason, or taken apart so that its parts, put together again,
// mean the same. The input is the text in UTF-8.
#include "core/bus/networkaddress_values.h"
#include "tests/fuzz/fuzzinput.h"

#include <QString>

using namespace dynascope;
using fuzz::must;

namespace {

QString nameOf(const NetworkAddress &address)
{
    const bool raw = address.kind == NetworkAddress::Kind::Raw;
    const bool brackets = address.host.contains(u':') || address.host.contains(u'%');
    QString name = raw ? QStringLiteral("tcp://") : QStringLiteral("rfc2217://");
    name += (brackets ? QStringLiteral("[%1]") : QStringLiteral("%1")).arg(address.host);
    name += u':' + QString::number(address.port);
    if (address.serverBaud > 0)
        name += QStringLiteral("?baud=") + QString::number(address.serverBaud);
    return name;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QString name = QString::fromUtf8(reinterpret_cast<const char *>(data), static_cast<qsizetype>(size));
    const Result<NetworkAddress> address = NetworkAddress::parse(name);
    if (!address) {
        must(address.error().kind == ErrorKind::PortUnsuitable && !address.error().text.isEmpty(), "a reason is given");
        return 0;
    }
    must(NetworkAddress::isNetworkName(name), "what can be taken apart is an address");
    must(isRateTheServers(name) == (address->kind == NetworkAddress::Kind::Raw), "raw bytes have the server's rate");
    must(!address->host.isEmpty() && address->port > 0, "host and port are there");
    must(NetworkAddress::parse(nameOf(*address)) == address, "the parts mean what the name means");
    return 0;
}
