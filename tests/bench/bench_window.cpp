// SPDX-License-Identifier: GPL-3.0-or-later
// The whole window over pty + QSerialPort with ten servos polled at full rate for a minute: start to first painted
// frame, from the first device's answer to its row on screen, memory, and the longest event of the GUI thread by its own CPU time. DYNASCOPE_BENCH_SECONDS shortens it.
#include "app/window/workshop.h"
#include "core/sim/servo.h"
#include "ui/plot/plotarea.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QStandardPaths>
#include <QTimer>
#include <QTreeView>

#include <algorithm>
#include <cstdio>
#include <ctime>

using namespace dynascope;

namespace {

double threadCpuMilliseconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double memoryMegabytes(const char *key)
{
    QFile status(QStringLiteral("/proc/self/status"));
    if (!status.open(QIODevice::ReadOnly))
        return 0;
    for (const QByteArray &line : status.readAll().split('\n')) {
        if (line.startsWith(key))
            return line.simplified().split(' ').value(1).toDouble() / 1024;
    }
    return 0;
}

/// Measures each outermost event by the CPU time its handling takes on this thread.
class MeasuringApplication : public QApplication
{
public:
    using QApplication::QApplication;

    bool notify(QObject *receiver, QEvent *event) override
    {
        if (m_depth > 0) {
            const bool wasHandled = QApplication::notify(receiver, event);
            if (event->type() == QEvent::Paint && firstDevice == LineTime() && showsDevice && showsDevice(receiver))
                firstDevice = std::chrono::steady_clock::now().time_since_epoch();
            return wasHandled;
        }
        ++m_depth;
        const int type = event->type();
        const char *name = receiver->metaObject()->className();
        const double begin = threadCpuMilliseconds();
        const bool handled = QApplication::notify(receiver, event);
        const double took = threadCpuMilliseconds() - begin;
        --m_depth;
        if (type == QEvent::Paint && !firstPaint.isValid())
            firstPaint.start();
        if (measuring) {
            ++events;
            over4 += took > 4 ? 1 : 0;
            over16 += took > 16 ? 1 : 0;
            if (took > longest) {
                longest = took;
                longestName = QStringLiteral("event %1 of %2").arg(type).arg(QString::fromLatin1(name));
            }
        }
        return handled;
    }

    bool measuring = false;
    double longest = 0;
    QString longestName;
    quint64 events = 0, over4 = 0, over16 = 0;
    QElapsedTimer firstPaint;
    std::function<bool(const QObject *)> showsDevice; ///< was it the tree that was painted, with a device in it?
    LineTime firstDevice{};

private:
    int m_depth = 0;
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
    QStandardPaths::setTestModeEnabled(true);
    MeasuringApplication application(argc, argv);
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
            cpuAtStart = threadCpuMilliseconds();
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
    MeasuringApplication::exec();
    const double cpu = (threadCpuMilliseconds() - cpuAtStart) / (static_cast<double>(minute.elapsed()) / 100);
    std::printf("window, 10 servos x 3 fields at 4 Mbps, 30 traces, %d s:\n"
                "  start to first painted frame %.0f ms (bus server included)\n"
                "  first device on screen %.0f ms after its answer\n"
                "  memory %.0f MB (peak %.0f MB)\n"
                "  %.0f cycles/s, %llu samples kept\n"
                "  GUI thread: %llu events, longest %.1f ms of its CPU time (%s), %llu over 4 ms, %llu over 16 ms, "
                "%.0f %% of a core\n",
                seconds, firstFrame, std::chrono::duration<double, std::milli>(application.firstDevice - answered).count(),
                memoryMegabytes("VmRSS:"), memoryMegabytes("VmHWM:"),
                rateCount ? rates / rateCount : 0.0, static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(application.events), application.longest,
                qPrintable(application.longestName), static_cast<unsigned long long>(application.over4),
                static_cast<unsigned long long>(application.over16), cpu);
    return 0;
}
