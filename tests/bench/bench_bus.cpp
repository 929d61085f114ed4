// SPDX-License-Identifier: GPL-3.0-or-later
// One read over pty and QSerialPort in wall time, and a full scan in virtual time.
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/bus/seriallinefactory.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "core/session/scanner.h"
#include "core/session/volatilespan.h"
#include "tests/support/sessionfixture.h"

#include <QCoreApplication>
#include <QThread>

#include <algorithm>
#include <chrono>
#include <cstdio>

using namespace dynascope;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int Reads = 5000;

double percentile(std::vector<double> &sorted, double part)
{
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// Bytes of both packets at the line's rate, return delay 0: what the wire itself takes.
double wireMicroseconds(int baudRate)
{
    return (14.0 + 15.0) * 10e6 / baudRate;
}

void readsOverPty(const Catalog &catalog)
{
    auto bus = std::make_unique<sim::SimulatedBus>(catalog);
    const auto specs = sim::parseServoSpecs(u"XM430-W350@4000000:1", catalog);
    if (!specs || !bus->add(specs->front()))
        qFatal("no simulated servo");
    auto server = sim::PtyServer::start(std::move(bus));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));
    SerialLineFactory factory;
    auto line = factory.open((*server)->path(), 4000000);
    if (!line)
        qFatal("%s", qPrintable(line.error().text));
    Bus wire(**line);
    const auto written = write(wire, {1, 9, {0}}); // Return Delay Time
    std::vector<double> microseconds;
    int failures = written ? 0 : 1;
    for (int i = 0; i < Reads; ++i) {
        const auto begin = Clock::now();
        failures += read(wire, {1, 132, 4}) ? 0 : 1;
        microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    }
    std::ranges::sort(microseconds);
    std::printf("read over pty + QSerialPort, 4 Mbps, return delay 0 (%d reads, %d failed):\n"
                "  p50 %.0f us, p99 %.0f us; the wire's own time %.0f us + 100 us of processing\n",
                Reads, failures, percentile(microseconds, 0.5), percentile(microseconds, 0.99),
                wireMicroseconds(4000000));
}

void scanInVirtualTime(const Catalog &catalog)
{
    const QString servos = QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288@57600:3,XM430-W350@57600:4,"
                                          "XM430-W350@1000000:5,XL430-W250@1000000:6,XL330-M288@1000000:7,"
                                          "XM430-W350@1000000:8,XM430-W350@4000000:9,XM430-W350@9600:252");
    VirtualBus wire(catalog, servos);
    const LineTime begin = wire.line->now();
    const auto wall = Clock::now();
    std::size_t found = 0;
    LineTime comparing{};
    const std::vector<int> bauds = likelyBauds(57600);
    for (const int baud : bauds) {
        if (!wire.bus->setBaudRate(baud))
            qFatal("baud %d refused", baud);
        const auto devices = scanBaud(*wire.bus, {0, 252});
        found += devices ? devices->devices.size() : 0;
        const LineTime all = wire.line->now();
        for (const Found &device : devices ? devices->devices : std::vector<Found>()) {
            const ControlTablePtr table = catalog.find(device.modelNumber, device.firmware);
            if (!compareReads(*wire.bus, device, *volatileSpanOf(*table), {}))
                qFatal("ID %d can't be read", device.id);
        }
        comparing += wire.line->now() - all;
    }
    const double seconds = std::chrono::duration<double>(wire.line->now() - begin - comparing).count();
    std::printf(
        "full scan, IDs 0-252 at %zu bauds, 10 servos: found %zu in %.2f s of virtual time, %.0f ms of wall time\n",
        bauds.size(), found, seconds, std::chrono::duration<double, std::milli>(Clock::now() - wall).count());
    std::printf("... and two reads of each, which tell two alike under one ID: %.2f s more\n",
                std::chrono::duration<double>(comparing).count());
}

} // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    // QSerialPort wants a QThread; without an event loop, as the bus thread has none.
    const std::unique_ptr<QThread> thread(QThread::create([&] { readsOverPty(*catalog); }));
    thread->start();
    thread->wait();
    scanInVirtualTime(*catalog);
}
