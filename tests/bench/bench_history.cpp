// SPDX-License-Identifier: GPL-3.0-or-later
// What a sample takes in memory, on what the simulator's servos answer to a real poll: 20 of them × 6 fields, all moving,
// in virtual time and over pty with this machine's jitter. And what it costs to append and to look up. CPU time.
#include "core/bus/operations.h"
#include "core/bus/poller.h"
#include "core/bus/seriallinefactory.h"
#include "core/session/histories.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"

#include <QCoreApplication>
#include <QThread>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr int Servos = 20;
constexpr int BaudRate = 4'000'000;
constexpr int Address = 124;
constexpr int Length = 23; ///< to Present Temperature

struct Part {
    const char *name;
    int address;
    int size;
};
constexpr std::array Fields{Part{"PWM", 124, 2}, Part{"Current", 126, 2}, Part{"Velocity", 128, 4},
    Part{"Position", 132, 4}, Part{"Voltage", 144, 2}, Part{"Temperature", 146, 1}};

double cpuSeconds()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

struct Taken {
    LineTime at;
    Watch watch;
    std::int32_t raw;
};

std::unique_ptr<sim::SimulatedBus> simulated(const Catalog &catalog)
{
    auto bus = std::make_unique<sim::SimulatedBus>(catalog);
    for (int id = 1; id <= Servos; ++id) {
        const auto servo = bus->add({QStringLiteral("XM430-W350"), -1, BaudRate, id});
        if (!servo)
            qFatal("%s", qPrintable(servo.error().text));
        (*servo)->write(u"Return Delay Time", 0);
    }
    return bus;
}

void moveAll(Bus &bus, LineTime now)
{
    std::vector<SpanData> goals;
    for (int id = 1; id <= Servos; ++id) {
        const double phase = std::chrono::duration<double>(now).count() * (0.5 + id * 0.05) + id;
        const auto goal = static_cast<quint32>(2048 + 900 * std::sin(phase * 2 * M_PI));
        goals.push_back({static_cast<std::uint8_t>(id), 116,
            {static_cast<std::uint8_t>(goal), static_cast<std::uint8_t>(goal >> 8), 0, 0}});
    }
    if (!writeMany(bus, goals))
        qFatal("the line failed");
}

void take(const Batch &batch, std::vector<Taken> &to)
{
    for (const PollValue &value : batch.values) {
        for (int field = 0; field < static_cast<int>(Fields.size()) && !value.data.empty(); ++field) {
            const Part &part = Fields[static_cast<std::size_t>(field)];
            std::uint32_t raw = 0;
            for (int i = part.size; i-- > 0;)
                raw = raw << 8 | value.data[static_cast<std::size_t>(part.address - Address + i)];
            to.push_back({value.at, {value.device, field},
                part.size == 2 ? static_cast<std::int16_t>(raw) : static_cast<std::int32_t>(raw)});
        }
    }
}

std::vector<Taken> poll(Line &line, bool fast, int cycles)
{
    Bus bus(line);
    Poller poller(bus);
    PollPlan plan;
    for (int id = 1; id <= Servos; ++id) {
        Traits traits;
        traits.id = static_cast<std::uint8_t>(id);
        traits.returnDelay = 0us;
        traits.returnDelayKnown = true;
        traits.fastReads = fast;
        traits.groupReads = true;
        plan.traits.push_back(traits);
        plan.spans.push_back({static_cast<quint32>(id), {traits.id, Address, Length}, 0ms});
        if (!write(bus, {traits.id, 64, {1}})) // Torque Enable
            qFatal("no servo");
    }
    poller.setPlan(plan);
    std::vector<Taken> taken;
    taken.reserve(static_cast<std::size_t>(cycles) * Servos * Fields.size());
    Batch batch;
    LineTime next{};
    for (int cycle = 0; cycle < cycles; ++cycle) {
        if (line.now() >= next) { // as a robot's own controller would
            moveAll(bus, line.now());
            next = line.now() + 20ms;
        }
        if (!poller.runCycle(batch))
            qFatal("the line failed");
        take(batch, taken);
    }
    return taken;
}

/// Bytes a sample, of all and of one field of one servo alone.
void printBytes(const char *name, const std::vector<Taken> &samples)
{
    Histories all;
    for (const Taken &sample : samples)
        all.append(sample.watch, sample.at, sample.raw);
    std::printf("  %-24s %8zu samples a field: %5.2f bytes; one field alone:", name, samples.size() / (Servos * Fields.size()),
        static_cast<double>(all.used()) / static_cast<double>(samples.size()));
    for (int field = 0; field < static_cast<int>(Fields.size()); ++field) {
        Histories one;
        std::size_t count = 0;
        for (const Taken &sample : samples) {
            if (sample.watch != Watch{7, field})
                continue;
            one.append(sample.watch, sample.at, sample.raw);
            ++count;
        }
        std::printf(" %s %.2f", Fields[static_cast<std::size_t>(field)].name,
            static_cast<double>(one.used()) / static_cast<double>(count));
    }
    std::printf("\n");
    std::fflush(stdout);
}

void printCosts(const std::vector<Taken> &samples)
{
    double begin = cpuSeconds();
    Histories all;
    for (const Taken &sample : samples)
        all.append(sample.watch, sample.at, sample.raw);
    std::printf("Append, with packing: %.1f ns a sample\n",
        (cpuSeconds() - begin) * 1e9 / static_cast<double>(samples.size()));
    // Half as much fits: nearly all is folded.
    Histories little(all.used() / 2);
    begin = cpuSeconds();
    for (const Taken &sample : samples)
        little.append(sample.watch, sample.at, sample.raw);
    std::printf("Append within half of that memory: %.1f ns a sample\n",
        (cpuSeconds() - begin) * 1e9 / static_cast<double>(samples.size()));
}

/// What one trace costs a frame that is painted anew: 1200 columns, and their range.
template <class Kind>
void printLookUp(const char *name, Kind &history, LineTime step, int samples)
{
    for (int i = 0; i < samples; ++i)
        history.append(step * i + LineTime(i * 7919LL % 50'000), static_cast<std::int32_t>(2048 + 900 * std::sin(i * 2e-3)) + i * 31 % 7);
    std::vector<typename Kind::Column> columns(1200);
    std::vector<double> times;
    for (int i = 0; i < 200; ++i) {
        const double begin = cpuSeconds();
        std::int32_t least = 0, most = 0;
        history.columns(step * i, step * (samples - 2 * i), columns);
        history.range(step * i, step * (samples - 2 * i), least, most);
        times.push_back((cpuSeconds() - begin) * 1e6);
    }
    std::ranges::nth_element(times, times.begin() + 100);
    std::printf("  %-10s %8d samples: %6.1f us\n", name, samples, times[100]);
}

} // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    std::printf("Bytes a sample all told, 20 servos x 6 fields at 4 Mbps, all moving:\n");
    std::vector<Taken> last;
    for (const bool fast : {true, false}) {
        const auto bus = simulated(*catalog);
        sim::SimulatedLine line(*bus, BaudRate);
        last = poll(line, fast, 30'000);
        printBytes(fast ? "virtual time, fast sync" : "virtual time, sync", last);
    }
    for (const bool fast : {true, false}) {
        const auto server = sim::PtyServer::start(simulated(*catalog));
        if (!server)
            qFatal("%s", qPrintable(server.error().text));
        std::vector<Taken> samples;
        const std::unique_ptr<QThread> thread(QThread::create([&] {
            SerialLineFactory factory;
            const auto line = factory.open((*server)->path(), BaudRate);
            if (!line)
                qFatal("%s", qPrintable(line.error().text));
            samples = poll(**line, fast, 10'000);
        }));
        thread->start();
        thread->wait();
        printBytes(fast ? "pty, fast sync" : "pty, sync", samples);
    }
    printCosts(last);
    std::printf("1200 columns and their range, median:\n");
    for (const int samples : {60'000, 1'000'000}) {
        History history;
        printLookUp("as it is", history, 600us, samples);
    }
}
