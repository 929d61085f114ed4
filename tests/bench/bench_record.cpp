// SPDX-License-Identifier: GPL-3.0-or-later
// What a recording costs: bytes a sample, the writer's time, and how long ten million samples take to open, to seek in
// and to read through.
#include "core/record/recording.h"
#include "core/record/recordingsink.h"
#include "core/replay/recordedlines.h"
#include "core/replay/replaydata.h"
#include "core/table/catalog.h"
#include "tests/support/recordings.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QTemporaryDir>

#include <algorithm>
#include <cstdio>

using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr quint32 Devices = 20;
constexpr int FlushEach = 1000; ///< cycles: a second
constexpr double SamplesACycle = Devices * 3.0;

double seconds(const QElapsedTimer &timer)
{
    return static_cast<double>(timer.nsecsElapsed()) * 1e-9;
}

void fail(const Error &error)
{
    std::printf("%s\n", qPrintable(error.text));
    std::exit(1);
}

void write(const QString &path, int cycles, bool finish)
{
    auto sink = createRecording(path, recordingHeader(Devices));
    if (!sink)
        fail(sink.error());
    double spent = 0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const RecordedBatch batch = recordedBatch(Devices, cycle);
        QElapsedTimer timer;
        timer.start();
        if (const auto written = (*sink)->write(batch); !written)
            fail(written.error());
        if ((cycle + 1) % FlushEach == 0)
            (void)(*sink)->flush();
        spent += seconds(timer);
    }
    if (finish)
        (void)(*sink)->finish();
    const double samples = cycles * SamplesACycle;
    const double size = static_cast<double>(QFileInfo(path).size());
    std::printf("  %-5s written: %.1f million samples, %.2f bytes a sample, %.0f ns a sample with the disk\n",
                qPrintable(QFileInfo(path).suffix()), samples * 1e-6, size / samples, spent / samples * 1e9);
}

void open(const QString &path, const char *what)
{
    QElapsedTimer timer;
    timer.start();
    auto recording = Recording::open(path);
    if (!recording)
        fail(recording.error());
    std::printf("  %s opened in %.1f ms: %llu batches in %zu parts\n", what, seconds(timer) * 1e3,
                static_cast<unsigned long long>((*recording)->messages()), (*recording)->parts());
    ReplaySource source(**recording);
    double longest = 0;
    const LineTime length = (*recording)->end() - (*recording)->begin();
    for (int part = 0; part < 100; ++part) {
        timer.restart();
        source.seek((*recording)->begin() + part * (length / 100));
        (void)source.next();
        longest = std::max(longest, seconds(timer));
    }
    timer.restart();
    source.seek(LineTime::min());
    quint64 batches = 0;
    while (source.next())
        ++batches;
    std::printf("          sought in %.1f ms at most, all of it read through in %.2f s\n", longest * 1e3, seconds(timer));
    if (batches != (*recording)->messages())
        std::printf("  WRONG: %llu batches read\n", static_cast<unsigned long long>(batches));
}

/// Until every sample of it can be plotted.
void show(const QString &path)
{
    auto catalog = Catalog::builtIn();
    if (!catalog)
        fail(catalog.error());
    RecordedLines lines;
    Session session(lines, *catalog);
    QElapsedTimer timer;
    timer.start();
    auto recording = Recording::open(path);
    if (!recording)
        fail(recording.error());
    const auto devices = addDevices(session, (*recording)->header());
    if (!devices)
        fail(devices.error());
    const double opened = seconds(timer);
    ReplayProgress progress;
    auto data = loadReplay(**recording, *devices, {}, Histories::DefaultBudget, progress);
    if (!data)
        fail(data.error());
    const double loaded = seconds(timer);
    std::printf("          in the window: devices after %.1f ms, all %llu samples after %.2f s, %.2f bytes each in memory\n",
                opened * 1e3, static_cast<unsigned long long>(data->samples), loaded,
                static_cast<double>(data->histories->used()) / static_cast<double>(data->samples));
}

} // namespace

/// bench_record [CYCLES [FOLDER]]: the folder keeps the files.
int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    const int cycles = argc > 1 ? std::atoi(argv[1]) : static_cast<int>(10'000'000 / SamplesACycle) + 1;
    const QTemporaryDir temporary;
    const QString folder = argc > 2 ? QString::fromLocal8Bit(argv[2]) : temporary.path();
    std::printf("recording: %u servos x 3 fields\n", Devices);
    write(folder + QStringLiteral("/whole.mcap"), cycles, true);
    write(folder + QStringLiteral("/cut.mcap"), cycles, false);
    write(folder + QStringLiteral("/whole.csv"), cycles, true);
    open(folder + QStringLiteral("/whole.mcap"), "with its index");
    show(folder + QStringLiteral("/whole.mcap"));
    open(folder + QStringLiteral("/cut.mcap"), "cut off");
    return 0;
}
