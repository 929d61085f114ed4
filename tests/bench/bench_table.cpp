// SPDX-License-Identifier: GPL-3.0-or-later
// What the library of control tables costs: at the start, when a bus of ten models is met, and all of it in memory.
#include "core/table/catalog.h"

#include <benchmark/benchmark.h>

#include <QDir>
#include <QFileInfo>

#include <cstdio>
#include <malloc.h>
#include <memory>
#include <span>

using namespace dynascope;

namespace {

/// Ten of one series, and the dearest ten: a family each, of every series.
constexpr int TenOfX[] = {1020, 1030, 1060, 1070, 1090, 1120, 1190, 1200, 1220, 1270};
constexpr int TenFamilies[] = {1020, 1060, 1200, 1220, 1110, 321, 350, 2020, 54024, 4050};

void start(benchmark::State &state)
{
    for (auto _ : state)
        benchmark::DoNotOptimize(Catalog::builtIn());
}
BENCHMARK(start)->Unit(benchmark::kMillisecond);

/// The start, and the tables of a bus with ten models.
void startAndTen(benchmark::State &state, std::span<const int> models)
{
    for (auto _ : state) {
        auto catalog = std::make_unique<Catalog>(Catalog::builtIn().value());
        for (const int model : models)
            benchmark::DoNotOptimize(catalog->find(model, 255));
        state.PauseTiming(); // it stays as long as the program runs
        catalog.reset();
        state.ResumeTiming();
    }
}
BENCHMARK_CAPTURE(startAndTen, OfX, TenOfX)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(startAndTen, OfTenFamilies, TenFamilies)->Unit(benchmark::kMillisecond);

void oneModel(benchmark::State &state)
{
    for (auto _ : state) {
        state.PauseTiming();
        const Catalog catalog = Catalog::builtIn().value();
        state.ResumeTiming();
        benchmark::DoNotOptimize(catalog.find(static_cast<int>(state.range(0)), 255));
    }
}
BENCHMARK(oneModel)->Arg(1020)->Arg(54024)->Arg(4050)->Unit(benchmark::kMillisecond);

void findAgain(benchmark::State &state)
{
    const Catalog catalog = Catalog::builtIn().value();
    (void)catalog.find(1020, 45);
    for (auto _ : state)
        benchmark::DoNotOptimize(catalog.find(1020, 45));
}
BENCHMARK(findAgain);

void everything(benchmark::State &state)
{
    for (auto _ : state) {
        const Catalog catalog = Catalog::builtIn().value();
        for (const Catalog::ModelInfo &info : catalog.models()) {
            for (const int firmware : catalog.firmwareSteps(info.modelNumber))
                benchmark::DoNotOptimize(catalog.find(info.modelNumber, firmware));
        }
    }
}
BENCHMARK(everything)->Unit(benchmark::kMillisecond);

void sizes()
{
    qint64 bytes = 0;
    int files = 0;
    for (const QFileInfo &file : QDir(QStringLiteral(":/controltables")).entryInfoList({QStringLiteral("*.json")})) {
        bytes += file.size();
        ++files;
    }
    const auto used = [] { return static_cast<double>(mallinfo2().uordblks) / 1024; };
    const double before = used();
    const Catalog catalog = Catalog::builtIn().value();
    const double started = used();
    for (const int model : TenFamilies)
        (void)catalog.find(model, 255);
    const double ten = used();
    std::size_t tables = 0, fields = 0;
    for (const Catalog::ModelInfo &info : catalog.models()) {
        for (const int firmware : catalog.firmwareSteps(info.modelNumber)) {
            fields += catalog.find(info.modelNumber, firmware)->fields().size();
            ++tables;
        }
    }
    std::printf("resources: %d files, %lld bytes\n", files, static_cast<long long>(bytes));
    std::printf("memory: %.0f KiB at the start, %.0f KiB with ten models, %.0f KiB with all %zu tables (%zu fields)\n",
                started - before, ten - before, used() - before, tables, fields);
}

} // namespace

int main(int argc, char **argv)
{
    benchmark::Initialize(&argc, argv);
    sizes();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
