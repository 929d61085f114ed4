// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/connection.h"

#include "app/dxl/options.h"
#include "core/bus/networklinefactory.h"
#include "core/bus/networkaddress_values.h"
#include "core/bus/seriallinefactory.h"

#include <cstdio>

namespace dynascope::dxl {

namespace {

void printPacket(Bus::Direction direction, LineTime at, ByteView packet)
{
    const QByteArray bytes(reinterpret_cast<const char *>(packet.data()), static_cast<qsizetype>(packet.size()));
    std::fprintf(stderr, "%12.3f ms %s %s\n", std::chrono::duration<double, std::milli>(at).count(),
                 direction == Bus::Direction::Sent ? ">" : "<", bytes.toHex(' ').toUpper().constData());
}

} // namespace

Connection::Connection(std::unique_ptr<Line> line)
    : m_line(std::move(line))
    , m_bus(*m_line)
{
}

Result<std::unique_ptr<Connection>> Connection::open(const Options &options)
{
    SerialLineFactory serial;
    NetworkLineFactory network;
    LineFactory &factory = network.knows(options.port) ? static_cast<LineFactory &>(network) : serial;
    auto line = factory.open(options.port, options.baudRate);
    if (!line && line.error().kind == ErrorKind::PortNotFound && options.port == u"sim") {
        return failure(ErrorKind::PortNotFound,
                       QStringLiteral("there is no port sim here: dxl sim --devices MODEL@BAUD:ID serves a simulated bus; "
                                      "pass the path that it prints as --port"));
    }
    if (!line)
        return tl::unexpected(line.error());
    std::unique_ptr<Connection> connection(new Connection(std::move(*line)));
    if (options.verbose) {
        const LineTime begin = connection->m_line->now();
        connection->m_bus.setTap([begin](Bus::Direction direction, LineTime at, ByteView packet) {
            printPacket(direction, at - begin, packet);
        });
    }
    return connection;
}

Error withAdvice(const Error &error, const Options &options)
{
    if (error.kind != ErrorKind::NothingReceived && error.kind != ErrorKind::NoHeader)
        return error;
    Error advised = error;
    if (isRateTheServers(options.port)) {
        advised.text += QStringLiteral("; the rate is the server's, is it that of the device?");
        return advised;
    }
    advised.text += QStringLiteral(" at %1 bps; to look for it at every baud rate: dxl --port %2 scan --bauds all")
                        .arg(QString::number(options.baudRate), options.port);
    return advised;
}

} // namespace dynascope::dxl
