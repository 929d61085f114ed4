// SPDX-License-Identifier: GPL-3.0-or-later
// What polling costs: the processor's time a read on a line that costs nothing, the crossing to the GUI thread, and how
// near to what the wire allows it comes over pty and QSerialPort.
#include "core/bus/poller.h"
#include "core/bus/pollprediction.h"
#include "core/bus/seriallinefactory.h"
#include "core/session/monitor.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "tests/support/nullline.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QThread>

#include <algorithm>
#include <cstdio>
#include <ctime>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

enum class Kind { Single, Sync, Fast };

struct KindName {
    Kind kind;
    const char *name;
};
constexpr std::array Kinds{
    KindName{Kind::Single, "single"}, KindName{Kind::Sync, "sync"}, KindName{Kind::Fast, "fast"}};

constexpr int Servos = 12;
constexpr int Length = 10; ///< Present Current, Velocity and Position: 126..135
constexpr int NullBaud = 4'000'000;
constexpr int PtyBaud = 1'000'000;
constexpr LineTime Processing = 100us; ///< of a simulated servo
constexpr int NullCycles = 200'000;
constexpr int Blocks = 20; ///< on a machine with other work the calmest one tells most
constexpr int BlockCycles = 200;
constexpr LineTime MeasuringTime = 2s; ///< what host and terminal add, for the prediction

double cpuSeconds(clockid_t clock)
{
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

double microseconds(LineTime duration)
{
    return std::chrono::duration<double, std::micro>(duration).count();
}

PollPlan planFor(Kind kind)
{
    return nullPlan(Servos, Length, kind == Kind::Fast, kind != Kind::Single);
}

void costsOnANullLine()
{
    std::printf("Bus and Poller on a line that costs nothing, %d devices x %d bytes, CPU time of the thread:\n", Servos,
        Length);
    for (const auto &[kind, name] : Kinds) {
        NullLine line;
        Bus bus(line);
        Poller poller(bus);
        poller.setPlan(planFor(kind));
        Batch batch;
        for (int cycle = 0; cycle < 1000; ++cycle)
            (void)poller.runCycle(batch);
        const double begin = cpuSeconds(CLOCK_THREAD_CPUTIME_ID);
        quint64 reads = 0;
        for (int cycle = 0; cycle < NullCycles; ++cycle) {
            if (!poller.runCycle(batch))
                qFatal("the line failed");
            reads += static_cast<quint64>(
                std::ranges::count_if(batch.values, [](const PollValue &value) { return !value.data.empty(); }));
        }
        const double seconds = cpuSeconds(CLOCK_THREAD_CPUTIME_ID) - begin;
        if (reads != quint64(NullCycles) * Servos)
            qFatal("values are missing");
        std::printf("  %-6s  %4.0f ns a read\n", name, seconds * 1e9 / static_cast<double>(reads));
    }
}

class NullFactory final : public LineFactory
{
public:
    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &, int) override { return std::make_unique<NullLine>(); }
};

/// The whole way from the bus thread into the devices, and into the histories that are plotted: what a read costs the
/// thread of either end.
void costsOfTheCrossing(const Catalog &catalog, bool plotted)
{
    NullFactory factory;
    Session session(factory, catalog);
    Monitor monitor(session);
    LineSession &line = session.open(QStringLiteral("null"), NullBaud);
    for (int id = 1; id <= Servos; ++id) {
        const Device &device = line.heard({static_cast<std::uint8_t>(id), NullBaud, 1020, 45, false, {}});
        if (plotted)
            monitor.watch({device.key(), device.table().indexOf(u"Present Position")});
    }
    monitor.setPaused(!plotted);
    quint64 reads = 0, taken = 0, first = 0, last = 0;
    QObject::connect(&line, &LineSession::batchTaken, &line, [&](const Batch &batch) {
        reads += batch.values.size();
        first = taken++ == 0 ? batch.cycle : first;
        last = batch.cycle;
    });
    QCoreApplication::processEvents(); // the monitor has said what it wants
    if (!plotted)
        line.bus().setPollPlan(planFor(Kind::Fast));
    QElapsedTimer time;
    time.start();
    const double begin = cpuSeconds(CLOCK_THREAD_CPUTIME_ID);
    const double beginAll = cpuSeconds(CLOCK_PROCESS_CPUTIME_ID);
    while (time.elapsed() < 3000)
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    const double gui = cpuSeconds(CLOCK_THREAD_CPUTIME_ID) - begin;
    const double bus = cpuSeconds(CLOCK_PROCESS_CPUTIME_ID) - beginAll - gui;
    if (reads == 0)
        qFatal("nothing came");
    const auto cycles = static_cast<double>(last - first + 1);
    std::printf("  %-36s  bus thread %4.0f ns, GUI thread %4.0f ns a read (%.0f %% of the batches taken)\n",
        plotted ? "4 bytes, into devices and histories:" : "10 bytes, into devices:", bus * 1e9 / (cycles * Servos),
        gui * 1e9 / static_cast<double>(reads), 100.0 * static_cast<double>(taken) / cycles);
}

/// What the wire allows, with the time a simulated servo takes to think.
LineTime limitOf(Kind kind)
{
    constexpr LineTime byteTime = 10us;
    switch (kind) {
    case Kind::Single: return Servos * ((25 + Length) * byteTime + Processing);
    case Kind::Sync: return (14 + Servos) * byteTime + Servos * ((11 + Length) * byteTime + Processing);
    case Kind::Fast: return (14 + Servos) * byteTime + (8 + Servos * (Length + 4)) * byteTime + Processing;
    }
    return {};
}

/// How long cycles took.
struct Cycles {
    std::vector<LineTime> each;
    LineTime whole{}; ///< what is between them included
    std::ptrdiff_t missing = 0;

    void add(const Cycles &other)
    {
        each.insert(each.end(), other.each.begin(), other.each.end());
        whole += other.whole;
        missing += other.missing;
    }
};

Cycles run(Line &line, Poller &poller)
{
    Cycles cycles;
    Batch batch;
    const LineTime begin = line.now();
    for (int cycle = 0; cycle < BlockCycles; ++cycle) {
        if (!poller.runCycle(batch))
            qFatal("the line failed");
        cycles.each.push_back(batch.end - batch.begin);
        cycles.missing +=
            std::ranges::count_if(batch.values, [](const PollValue &value) { return value.data.empty(); });
    }
    cycles.whole = line.now() - begin;
    return cycles;
}

void print(Cycles &cycles, LineTime limit)
{
    std::ranges::sort(cycles.each);
    const std::size_t count = cycles.each.size();
    const LineTime median = cycles.each[count / 2];
    const LineTime p99 = cycles.each[count * 99 / 100];
    std::printf("  efficiency %.3f, median %.0f us, p99 %.0f us = %.2f x median, %td missing",
        microseconds(limit) * static_cast<double>(count) / microseconds(cycles.whole), microseconds(median),
        microseconds(p99), microseconds(p99) / microseconds(median), cycles.missing);
}

void cyclesOverPty(const Catalog &catalog)
{
    auto simulated = std::make_unique<sim::SimulatedBus>(catalog);
    for (int id = 1; id <= Servos; ++id) {
        const auto servo = simulated->add({QStringLiteral("XM430-W350"), -1, PtyBaud, id});
        if (!servo)
            qFatal("%s", qPrintable(servo.error().text));
        (*servo)->write(u"Return Delay Time", 0);
    }
    const auto server = sim::PtyServer::start(std::move(simulated));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));
    SerialLineFactory factory;
    const auto line = factory.open((*server)->path(), PtyBaud);
    if (!line)
        qFatal("%s", qPrintable(line.error().text));
    std::printf("Over pty + QSerialPort, 1 Mbps, %d servos x %d bytes, return delay 0, %d cycles each; the calmest "
                "%d of them behind the bar. Predicted before they run, with what was measured until then:\n",
        Servos, Length, Blocks * BlockCycles, BlockCycles);
    for (const auto &[kind, name] : Kinds) {
        Bus bus(**line);
        Poller poller(bus);
        poller.setPlan(planFor(kind));
        std::vector<Cycles> blocks;
        Cycles all;
        const LineTime measured = (*line)->now() + MeasuringTime;
        while ((*line)->now() < measured)
            (void)run(**line, poller);
        const PollPrediction predicted = predictPoll(planFor(kind), PtyBaud, poller.delays());
        for (int block = 0; block < Blocks; ++block) {
            blocks.push_back(run(**line, poller));
            all.add(blocks.back());
        }
        Cycles &calmest = *std::ranges::min_element(blocks, {}, &Cycles::whole);
        const double achieved = Blocks * BlockCycles / (microseconds(all.whole) * 1e-6);
        std::printf(
            "  %-6s  predicted %.1f Hz (%.0f us an exchange, %.0f us a cycle measured), achieved %.1f Hz: %.3f\n", name,
            predicted.cycleRate, microseconds(poller.delays().perExchange), microseconds(poller.delays().perCycle),
            achieved, achieved / predicted.cycleRate);
        std::printf("  %-6s  limit %.0f us", name, microseconds(limitOf(kind)));
        print(all, limitOf(kind));
        std::printf("  |");
        print(calmest, limitOf(kind));
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    costsOnANullLine();
    std::printf("With the crossing to the GUI thread, the bus thread running as fast as it can:\n");
    for (const bool plotted : {false, true})
        costsOfTheCrossing(*catalog, plotted);
    const std::unique_ptr<QThread> thread(QThread::create([&] { cyclesOverPty(*catalog); }));
    thread->start();
    thread->wait();
}
