// SPDX-License-Identifier: GPL-3.0-or-later
// The whole program over pty + QSerialPort as it is left open all day. At rest: one servo at 50 Hz. At work: 20 servos
// × 6 fields at the full rate of 4 Mbps fast reads, with two plots, grid, dashboard and recording on; what was recorded is
// held to what was asked and answered on the wire, by the simulator's own log. CPU time without the simulator's thread.
// DYNASCOPE_BENCH_SECONDS: how long at work, 60 if it isn't set.
#include "app/window/workshop.h"
#include "core/protocol/parser.h"
#include "core/protocol/requests.h"
#include "core/record/recording.h"
#include "core/sim/servo.h"
#include "tests/bench/measuring.h"
#include "ui/devices/devicepanel.h"
#include "ui/plot/plotarea.h"
#include "ui/record/recordactions.h"
#include "ui/record/recordwishes.h"

#include <QAction>
#include <QTemporaryDir>
#include <QTimer>

#include <cstdio>
#include <set>

using namespace dynascope;

namespace {

constexpr int PositionAddress = 132, PositionEnd = 136;

bool coversPosition(std::uint16_t address, std::size_t length)
{
    return address <= PositionAddress && address + length >= PositionEnd;
}

/// Present Positions that went over the wire. On the server's thread.
struct WireCount {
    quint64 asked = 0, answered = 0;
    int open = 0; ///< answers to come to the latest request
    Parser parser;

    void add(const sim::WireEntry &entry)
    {
        if (!entry.fromController) {
            if (open > 0) {
                ++answered;
                --open;
            }
            return;
        }
        open = 0;
        parser.feed(entry.bytes); // on a busy machine a packet may reach the wire in two pieces
        while (const auto event = parser.next()) {
            const auto *packet = std::get_if<Parser::Packet>(&*event);
            if (!packet)
                continue;
            const auto command = decodeCommand(packet->request());
            if (!command)
                continue;
            if (const auto *read = std::get_if<ReadCommand>(&*command); read && coversPosition(read->address, read->length))
                ++open;
            if (const auto *group = std::get_if<GroupReadCommand>(&*command)) {
                for (const Span &span : group->spans)
                    open += coversPosition(span.address, span.length) ? 1 : 0;
            }
        }
        asked += static_cast<quint64>(open);
    }
};

/// Servos of one model at 4 Mbps, which answer at once and move.
std::unique_ptr<sim::PtyServer> serve(const Catalog &catalog, int servos)
{
    auto bus = std::make_unique<sim::SimulatedBus>(catalog);
    for (int id = 1; id <= servos; ++id) {
        const auto servo = bus->add({QStringLiteral("XM430-W350"), -1, 4000000, id, -1});
        if (!servo)
            qFatal("%s", qPrintable(servo.error().text));
        (void)(*servo)->write(u"Return Delay Time", 0);
        (void)(*servo)->write(u"Operating Mode", 1);
        (void)(*servo)->write(u"Torque Enable", 1);
        (void)(*servo)->write(u"Goal Velocity", 20 + id);
    }
    auto server = sim::PtyServer::start(std::move(bus));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));
    return std::move(*server);
}

/// A program on a bus of its own, led through its phases by a timer.
class Scene : public QObject
{
public:
    Scene(bench::MeasuringApplication &application, const Catalog &catalog, int servos)
        : m_application(application)
        , m_server(serve(catalog, servos))
        , m_workshop(application, {})
        , m_servos(static_cast<std::size_t>(servos))
    {
        m_workshop.window().resize(1440, 900);
        m_workshop.window().show();
        m_workshop.window().connectTo(m_server->path(), 4000000);
        connect(&m_drain, &QTimer::timeout, this, &Scene::drain);
        m_drain.start(200);
    }

    /// Runs the event loop until it holds; ends the program where it doesn't in half a minute.
    template<typename Condition>
    void until(const char *what, Condition condition)
    {
        QElapsedTimer waited;
        waited.start();
        while (!condition()) {
            if (waited.elapsed() > 30000)
                qFatal("%s did not come about", what);
            runFor(20);
        }
    }
    void runFor(int milliseconds)
    {
        QTimer::singleShot(milliseconds, &m_application, &QCoreApplication::quit);
        QApplication::exec();
    }
    void findAll()
    {
        until("finding the servos", [this] {
            return m_workshop.session().devices().size() == m_servos && !m_workshop.scanner().isRunning();
        });
        m_workshop.monitor().setPaused(true);
        runFor(500);
    }
    void drain()
    {
        m_server->call([this](sim::SimulatedBus &bus, LineTime) {
            if (!bus.log().empty() && bus.log().back().fromController)
                return; // it may still be on its way; the next time takes it
            for (const sim::WireEntry &entry : bus.log())
                m_count.add(entry);
            bus.clearLog();
        });
    }
    double cpu()
    {
        double simulator = 0;
        m_server->call([&](sim::SimulatedBus &, LineTime) { simulator = bench::cpuMilliseconds(); });
        return bench::cpuMilliseconds(CLOCK_PROCESS_CPUTIME_ID) - simulator;
    }
    /// As often as the line allows: a rate that was wanted before is remembered.
    void addTrace(PlotArea &plots, const Device &device, const char *field)
    {
        const TraceKey trace = key(device, field);
        plots.addTrace(trace);
        m_workshop.monitor().setRate(trace.watch, 0);
    }
    TraceKey key(const Device &device, const char *field) const
    {
        return {device.key(), device.table().indexOf(QString::fromLatin1(field))};
    }
    QAction *action(const char *name) { return m_workshop.window().findChild<QAction *>(QString::fromLatin1(name)); }

    bench::MeasuringApplication &m_application;
    std::unique_ptr<sim::PtyServer> m_server;
    Workshop m_workshop;
    std::size_t m_servos;
    QTimer m_drain;
    WireCount m_count;
};

void atRest(bench::MeasuringApplication &application, const Catalog &catalog)
{
    Scene scene(application, catalog, 1);
    scene.findAll();
    Monitor &monitor = scene.m_workshop.monitor();
    const TraceKey key = scene.key(*scene.m_workshop.session().devices().front(), "Present Position");
    scene.m_workshop.window().findChild<PlotArea *>()->addTrace(key);
    monitor.setRate(key.watch, 50);
    monitor.setPaused(false);
    scene.runFor(2000);
    constexpr int Seconds = 20;
    const double begin = scene.cpu(), ownBegin = bench::cpuMilliseconds();
    const std::uint64_t samplesBegin = monitor.history(key.watch)->appended();
    scene.runFor(Seconds * 1000);
    std::printf("at rest, one servo at 50 Hz, one trace, %d s: %.1f samples/s; %.1f %% of a core, of which the GUI thread %.1f %%\n",
                Seconds, static_cast<double>(monitor.history(key.watch)->appended() - samplesBegin) / Seconds, (scene.cpu() - begin) / (Seconds * 10),
                (bench::cpuMilliseconds() - ownBegin) / (Seconds * 10));
}

/// Two panels with three fields each of all devices, grid of one, dashboard, recording: all while nothing is polled yet.
void setUp(Scene &scene)
{
    auto *plots = scene.m_workshop.window().findChild<PlotArea *>();
    const auto fill = [&](std::initializer_list<const char *> fields) {
        for (const Device *device : scene.m_workshop.session().devices()) {
            for (const char *field : fields)
                scene.addTrace(*plots, *device, field);
        }
    };
    fill({"Present Position", "Present Velocity", "Present Current"});
    plots->addPanel();
    fill({"Present PWM", "Present Input Voltage", "Present Temperature"});
    auto *panel = scene.m_workshop.window().findChild<DevicePanel *>();
    panel->selectDevice(scene.m_workshop.session().devices().front());
    scene.action("dashboardAction")->trigger();
    scene.action("recordAction")->trigger();
}

/// Present Positions in the files of a folder: those that came, and those asked for in vain.
std::pair<quint64, quint64> recorded(const QString &folder)
{
    quint64 came = 0, missed = 0;
    for (const QFileInfo &file : QDir(folder).entryInfoList({QStringLiteral("*.mcap")})) {
        auto recording = Recording::open(file.filePath());
        if (!recording)
            qFatal("%s", qPrintable(recording.error().text));
        ReplaySource source(**recording);
        while (const auto batch = source.next()) {
            for (const RecordedReply &reply : batch->replies) {
                if (coversPosition(reply.address, reply.length))
                    ++(reply.data.empty() ? missed : came);
            }
        }
    }
    return {came, missed};
}

void atWork(bench::MeasuringApplication &application, const Catalog &catalog, int seconds)
{
    const QTemporaryDir folder;
    RecordWishes wishes = RecordWishes::saved();
    wishes.folder = folder.path();
    wishes.save();
    Scene scene(application, catalog, 20);
    scene.findAll();
    setUp(scene);
    auto *records = scene.m_workshop.window().findChild<RecordActions *>();
    scene.until("the recording", [&] { return records->recorder().isRunning(); });
    scene.runFor(3000); // whole tables are read for its header, by jobs
    scene.m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.setLogging(true); });
    LineSession &line = *scene.m_workshop.session().lines().front();
    quint64 taken = 0; // answers that came in time; others are asked for again, or missed
    QObject::connect(&line, &LineSession::batchTaken, &scene, [&taken](const Batch &batch) {
        std::set<DeviceKey> devices; // one answer may be two values: of what is plotted, of what is in the table
        for (const PollValue &value : batch.values) {
            if (!value.data.empty() && coversPosition(value.address, value.length))
                devices.insert(value.device);
        }
        taken += devices.size();
    });
    scene.m_workshop.monitor().setPaused(false);
    scene.runFor(2000);

    application.figures = {};
    application.measuring = true;
    const double begin = scene.cpu(), ownBegin = bench::cpuMilliseconds();
    scene.runFor(seconds * 1000);
    const double rate = line.cycleRate(), predicted = line.prediction().cycleRate;
    const double all = (scene.cpu() - begin) / (seconds * 10), own = (bench::cpuMilliseconds() - ownBegin) / (seconds * 10);
    application.measuring = false;

    scene.m_workshop.monitor().setPaused(true);
    scene.runFor(1000);
    scene.action("recordAction")->trigger();
    scene.until("the recording's end", [&] { return !records->recorder().isRunning() && !records->recorder().isEnding(); });
    scene.drain();
    const RecorderStatus status = records->recorder().status();
    const auto [came, missed] = recorded(folder.path());
    const bench::EventFigures &figures = application.figures;
    std::printf("at work, 20 servos x 6 fields at 4 Mbps, two plots, grid, dashboard, recording, %d s: %.0f cycles/s, %.3f of "
                "those predicted\n"
                "  CPU time %.0f %% of a core, of which the GUI thread %.0f %%; memory %.0f MB\n"
                "  GUI thread: %llu events, longest %.1f ms of its CPU time (%s), %.1f ms by the wall; %llu over 4 ms, "
                "%llu over 16 ms\n"
                "  Present Positions asked for on the wire %llu, answered %llu, taken %llu (the others came late and "
                "were asked for again, or are missing); recorded %llu and %llu missing; the recorder says %llu samples, %llu lost, %.1f MB (%.2f bytes a sample)\n",
                seconds, rate, rate / predicted, all, own, bench::memoryMegabytes("VmRSS:"), static_cast<unsigned long long>(figures.events),
                figures.longest, qPrintable(figures.longestName), figures.longestWall,
                static_cast<unsigned long long>(figures.over4), static_cast<unsigned long long>(figures.over16),
                static_cast<unsigned long long>(scene.m_count.asked), static_cast<unsigned long long>(scene.m_count.answered),
                static_cast<unsigned long long>(taken), static_cast<unsigned long long>(came), static_cast<unsigned long long>(missed),
                static_cast<unsigned long long>(status.samples), static_cast<unsigned long long>(status.lost),
                static_cast<double>(status.bytes) * 1e-6,
                static_cast<double>(status.bytes) / static_cast<double>(std::max<quint64>(1, status.samples)));
}

} // namespace

int main(int argc, char **argv)
{
    const bench::OwnSettings settings;
    bench::MeasuringApplication application(argc, argv);
    QApplication::setQuitOnLastWindowClosed(false);
    setUpApplication(application);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    const int wanted = qEnvironmentVariableIntValue("DYNASCOPE_BENCH_SECONDS");
    atRest(application, *catalog);
    std::fflush(stdout);
    atWork(application, *catalog, wanted > 0 ? wanted : 60);
    return 0;
}
