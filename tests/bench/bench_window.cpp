// SPDX-License-Identifier: GPL-3.0-or-later
// The whole window over pty + QSerialPort with ten servos polled at full rate for a minute: start to first painted
// frame, from the first device's answer to its row on screen, memory, and the longest event of the GUI thread by its own
// CPU time. DYNASCOPE_BENCH_SECONDS shortens it.
#include "app/window/workshop.h"
#include "core/sim/servo.h"
#include "tests/bench/measuring.h"
#include "ui/plot/plotarea.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QTimer>
#include <QTreeView>

#include <algorithm>
#include <cstdio>
#include <ctime>

using namespace dynascope;

namespace {

/// Knows besides when the first device was painted.
class WatchingApplication : public bench::MeasuringApplication
{
public:
    using MeasuringApplication::MeasuringApplication;

    std::function<bool(const QObject *)> showsDevice; ///< was it the tree that was painted, with a device in it?
    LineTime firstDevice{};

protected:
    void sawInner(QObject *receiver, QEvent *event) override
    {
        if (event->type() == QEvent::Paint && firstDevice == LineTime() && showsDevice && showsDevice(receiver))
            firstDevice = std::chrono::steady_clock::now().time_since_epoch();
    }
};

std::unique_ptr<sim::PtyServer> tenServos(const Catalog &catalog)
{
    auto bus = std::make_unique<sim::SimulatedBus>(catalog);
    QStringList names;
    for (int id = 1; id <= 10; ++id)
        names << QStringLiteral("XM430-W350@4000000:%1").arg(id);
    const auto specs = sim::parseServoSpecs(names.join(QLatin1Char(',')), catalog);
    if (!specs)
        qFatal("%s", qPrintable(specs.error().text));
    for (const sim::ServoSpec &spec : *specs) {
        if (!bus->add(spec))
            qFatal("no servo");
    }
    auto server = sim::PtyServer::start(std::move(bus));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));
    return std::move(*server);
}

/// When the last byte of the first answer had come, by the wire's own log.
LineTime firstAnswer(sim::PtyServer &server)
{
    LineTime end{};
    server.call([&end](sim::SimulatedBus &bus, LineTime) {
        const auto answer = std::ranges::find(bus.log(), false, &sim::WireEntry::fromController);
        if (answer != bus.log().end())
            end = answer->end;
        bus.setLogging(false);
    });
    return end;
}

} // namespace

int main(int argc, char **argv)
{
    QElapsedTimer sinceStart;
    sinceStart.start();
    const bench::OwnSettings settings;
    WatchingApplication application(argc, argv);
    setUpApplication(application);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    const auto server = tenServos(*catalog);
    Workshop workshop(application, {});
    workshop.window().resize(1440, 900);
    workshop.window().show();
    server->call([](sim::SimulatedBus &bus, LineTime) { bus.setLogging(true); });
    application.showsDevice = [&workshop](const QObject *painted) {
        const auto *tree = workshop.window().findChild<QTreeView *>(QStringLiteral("deviceTree"));
        return tree && painted == tree->viewport() && !workshop.session().devices().empty();
    };
    workshop.window().connectTo(server->path(), 4000000);

    const int seconds = std::max(1, qEnvironmentVariableIntValue("DYNASCOPE_BENCH_SECONDS") > 0
                                        ? qEnvironmentVariableIntValue("DYNASCOPE_BENCH_SECONDS")
                                        : 60);
    double firstFrame = 0;
    LineTime answered{};
    quint64 samples = 0;
    double rates = 0;
    int rateCount = 0;
    double cpuAtStart = 0;
    QTimer poll;
    QElapsedTimer minute;
    QObject::connect(&poll, &QTimer::timeout, &application, [&] {
        if (firstFrame == 0 && application.firstPaint.isValid())
            firstFrame = static_cast<double>(sinceStart.elapsed() - application.firstPaint.elapsed());
        const std::vector<Device *> devices = workshop.session().devices();
        if (!application.measuring && devices.size() == 10 && !workshop.scanner().isRunning()) {
            auto *plots = workshop.window().findChild<PlotArea *>();
            for (const Device *device : devices) {
                for (const char *name : {"Present Position", "Present Velocity", "Present Current"})
                    plots->addTrace({device->key(), device->table().indexOf(QString::fromLatin1(name))});
            }
            answered = firstAnswer(*server);
            application.measuring = true;
            cpuAtStart = bench::cpuMilliseconds();
            minute.start();
        }
        if (application.measuring && minute.elapsed() > 1500) {
            rates += workshop.session().lines().front()->cycleRate();
            ++rateCount;
        }
        if (application.measuring && minute.elapsed() > seconds * 1000) {
            for (const Watch &watch : workshop.monitor().watches()) {
                if (const History *history = workshop.monitor().history(watch))
                    samples += history->size();
            }
            application.quit();
        }
    });
    poll.start(50);
    QTimer::singleShot((seconds + 30) * 1000, &application, [] { qFatal("ten servos were not found in time"); });
    QApplication::exec();
    const double cpu = (bench::cpuMilliseconds() - cpuAtStart) / (static_cast<double>(minute.elapsed()) / 100);
    std::printf("window, 10 servos x 3 fields at 4 Mbps, 30 traces, %d s:\n"
                "  start to first painted frame %.0f ms (bus server included)\n"
                "  first device on screen %.0f ms after its answer\n"
                "  memory %.0f MB (peak %.0f MB)\n"
                "  %.0f cycles/s, %llu samples kept\n"
                "  GUI thread: %llu events, longest %.1f ms of its CPU time (%s), %llu over 4 ms, %llu over 16 ms, "
                "%.0f %% of a core\n",
                seconds, firstFrame, std::chrono::duration<double, std::milli>(application.firstDevice - answered).count(),
                bench::memoryMegabytes("VmRSS:"), bench::memoryMegabytes("VmHWM:"),
                rateCount ? rates / rateCount : 0.0, static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(application.figures.events), application.figures.longest,
                qPrintable(application.figures.longestName), static_cast<unsigned long long>(application.figures.over4),
                static_cast<unsigned long long>(application.figures.over16), cpu);
    return 0;
}
