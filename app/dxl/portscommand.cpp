// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/chooseport.h"
#include "app/dxl/commands.h"
#include "core/bus/seriallinefactory.h"
#include "core/bus/serialport_posix.h"

namespace dynascope::dxl {

namespace {

void show(Output &output, const PortInfo &port)
{
    Document document;
    document.add("port", port.name)
        .add("description", port.description)
        .add("serial_number", port.serialNumber)
        .add("identity", port.identity);
    QString text = portText(port);
    if (const auto latency = posix::latencyTimer(port.name)) {
        const double milliseconds = std::chrono::duration<double, std::milli>(*latency).count();
        document.add("latency_ms", milliseconds);
        text += QStringLiteral(", holds bytes for %1 ms").arg(milliseconds);
    }
    const QString holder = posix::holderOf(port.name);
    if (!holder.isEmpty()) {
        document.add("holder", holder);
        text += QStringLiteral(", in use by %1").arg(holder);
    }
    output.result(text, document);
}

} // namespace

ExitCode portsCommand(Output &output)
{
    output.expectMany();
    const std::vector<PortInfo> ports = SerialPortList().ports();
    for (const PortInfo &port : ports)
        show(output, port);
    if (ports.empty())
        output.note(QStringLiteral("there is no serial port here; --port also takes sim, tcp://HOST:PORT and "
                                   "rfc2217://HOST:PORT"));
    return ExitCode::Done;
}

ExitCode versionCommand(Output &output)
{
    Document document;
    document.add("program", QStringLiteral("dxl"))
        .add("version", QStringLiteral(DYNASCOPE_VERSION))
        .add("json", qint64(JsonVersion));
    output.result(QStringLiteral("dxl %1, JSON version %2").arg(QStringLiteral(DYNASCOPE_VERSION)).arg(JsonVersion),
                  document);
    return ExitCode::Done;
}

} // namespace dynascope::dxl
