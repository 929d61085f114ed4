// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/chooseport.h"

#include <QStringList>

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// What is plugged in describes itself; a board's own ports do not.
bool isAdapter(const PortInfo &port)
{
    return !port.identity.isEmpty() || port.name.contains(QLatin1String("USB"))
           || port.name.contains(QLatin1String("ACM"));
}

QString listed(const std::vector<PortInfo> &ports)
{
    QStringList texts;
    for (const PortInfo &port : ports)
        texts << (port.description.isEmpty() ? port.name : QStringLiteral("%1 (%2)").arg(port.name, port.description));
    return texts.join(QStringLiteral(", "));
}

} // namespace

Result<QString> choosePort(const std::vector<PortInfo> &ports)
{
    std::vector<PortInfo> adapters;
    std::ranges::copy_if(ports, std::back_inserter(adapters), isAdapter);
    if (adapters.size() == 1)
        return adapters.front().name;
    if (adapters.size() > 1) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("which port? There are %1 adapters: %2; say --port PATH")
                           .arg(adapters.size())
                           .arg(listed(adapters)));
    }
    const QString others = ports.empty()
                               ? QString()
                               : QStringLiteral("; the ports that there are, %1, are no adapters").arg(listed(ports));
    return failure(ErrorKind::InvalidArgument,
                   QStringLiteral("no adapter is plugged in%1: say --port PATH, --port sim for a demo, or "
                                  "tcp://HOST:PORT, rfc2217://HOST:PORT")
                       .arg(others));
}

QString portText(const PortInfo &port)
{
    QStringList parts;
    if (!port.description.isEmpty())
        parts << port.description;
    if (!port.serialNumber.isEmpty())
        parts << QStringLiteral("serial number %1").arg(port.serialNumber);
    return parts.isEmpty() ? port.name : QStringLiteral("%1  %2").arg(port.name, parts.join(QStringLiteral(", ")));
}

} // namespace dynascope::dxl
