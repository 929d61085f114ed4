// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/connection.h"

#include "app/dxl/interrupt.h"
#include "app/dxl/options.h"
#include "app/dxl/packettext.h"
#include "core/bus/networklinefactory.h"
#include "core/bus/networkaddress_values.h"
#include "core/bus/seriallinefactory.h"
#include "core/sim/demo.h"

#include <cstdio>

namespace dynascope::dxl {

namespace {

constexpr QStringView SimulatedPort = u"sim";


/// Each packet with its time since the first, and what it says.
class PacketLog
{
public:
    explicit PacketLog(LineTime begin) : m_begin(begin) {}

    void print(Bus::Direction direction, LineTime at, ByteView packet)
    {
        std::fprintf(stderr, "%12.3f ms %s %s  %s\n", std::chrono::duration<double, std::milli>(at - m_begin).count(),
                     direction == Bus::Direction::Sent ? ">" : "<", qUtf8Printable(hexText(packet)),
                     qUtf8Printable(m_text.describe(packet)));
    }

private:
    LineTime m_begin;
    PacketText m_text;
};

std::optional<LineTime> allowance(const Options &options)
{
    return options.timeout ? std::optional<LineTime>(std::chrono::milliseconds(*options.timeout)) : std::nullopt;
}

} // namespace

Connection::Connection(std::unique_ptr<Line> line, std::unique_ptr<sim::Demo> demo)
    : m_demo(std::move(demo))
    , m_line(std::move(line))
    , m_bus(*m_line)
{
    m_bus.setCancel(&interrupted());
}

Connection::~Connection() = default;

Result<std::unique_ptr<Connection>> Connection::open(const Catalog &catalog, const Options &options)
{
    SerialLineFactory serial({allowance(options)});
    NetworkOptions overNetwork;
    overNetwork.hostAllowance = allowance(options);
    NetworkLineFactory network(overNetwork);
    std::unique_ptr<sim::Demo> demo;
    QString path = options.port;
    if (options.port == SimulatedPort) {
        auto started = sim::Demo::start(catalog);
        if (!started)
            return tl::unexpected(started.error());
        demo = std::move(*started);
        path = demo->path();
    }
    LineFactory &factory = network.knows(path) ? static_cast<LineFactory &>(network) : serial;
    auto line = factory.openUnless(interrupted(), path, options.baudRate);
    if (!line)
        return tl::unexpected(line.error());
    std::unique_ptr<Connection> connection(new Connection(std::move(*line), std::move(demo)));
    if (options.verbose) {
        const auto log = std::make_shared<PacketLog>(connection->m_line->now());
        connection->m_bus.setTap(
            [log](Bus::Direction direction, LineTime at, ByteView packet) { log->print(direction, at, packet); });
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
