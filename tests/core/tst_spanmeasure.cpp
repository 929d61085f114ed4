// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/spanmeasure.h"
#include "tests/support/testmain.h"

#include <cmath>
#include <numbers>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// The plain formulas, in floating point.
Measured plain(const History &history, LineTime from, LineTime to)
{
    Measured result;
    for (std::size_t i = history.indexAt(from); i < history.indexAt(to); ++i) {
        const std::int32_t raw = history.at(i).raw;
        result.minimum = result.samples == 0 ? raw : std::min(result.minimum, raw);
        result.maximum = result.samples == 0 ? raw : std::max(result.maximum, raw);
        result.mean += raw;
        result.meanSquare += static_cast<double>(raw) * raw;
        ++result.samples;
    }
    result.mean /= static_cast<double>(result.samples);
    result.meanSquare /= static_cast<double>(result.samples);
    return result;
}

bool alike(const Measured &one, const Measured &other)
{
    return one.samples == other.samples && one.minimum == other.minimum && one.maximum == other.maximum
        && std::abs(one.mean - other.mean) <= 1e-9 * std::max(1.0, std::abs(other.mean))
        && std::abs(one.meanSquare - other.meanSquare) <= 1e-9 * std::max(1.0, other.meanSquare);
}

/// A sine of so many Hz about `mean`, sampled each millisecond, with a little noise.
void appendSine(History &history, double hertz, double mean, double amplitude, int from, int samples, int noise = 0)
{
    quint32 state = 7;
    for (int i = from; i < from + samples; ++i) {
        state = state * 1664525U + 1013904223U;
        const int jitter = noise > 0 ? static_cast<int>(state >> 16U) % (2 * noise + 1) - noise : 0;
        history.append(1ms * i,
            static_cast<std::int32_t>(std::lround(mean + amplitude * std::sin(2 * std::numbers::pi * hertz * i / 1000)))
                + jitter);
    }
}

} // namespace

class TestSpanMeasure : public QObject
{
    Q_OBJECT

private slots:
    void whatIsBetweenIsMeasured()
    {
        History history;
        appendSine(history, 5, 2000, 300, 0, 10'000);
        QVERIFY(alike(measure(history, 0s, 10s), plain(history, 0s, 10s)));
        QVERIFY(alike(measure(history, 1234ms, 5678ms), plain(history, 1234ms, 5678ms)));
        const Measured whole = measure(history, 0s, 10s);
        QVERIFY(whole.hertz);
        QVERIFY(std::abs(*whole.hertz - 5) < 0.005);
        // RMS in physical units: of a sine about its mean amplitude / √2, with the mean as the zero.
        QVERIFY(std::abs(whole.rms(0.5, -1000) - 150 / std::numbers::sqrt2) < 0.1);
        QVERIFY(std::abs(whole.rms(0.5, 0) - std::sqrt(1000.0 * 1000 + 150 * 150 / 2.0)) < 0.1);
    }

    void nothingIsNothing()
    {
        History history;
        QCOMPARE(measure(history, 0s, 1s).samples, std::uint64_t(0));
        history.append(1s, 5);
        QCOMPARE(measure(history, 2s, 3s).samples, std::uint64_t(0));
        QCOMPARE(measure(history, 3s, 0s).samples, std::uint64_t(0));
        QVERIFY(measure(history, 0s, 3s) == (Measured{1, 5, 5, 5, 25, {}}));
    }

    void theLargestNumbersDontOverflow()
    {
        History history;
        for (int i = 0; i < 100'000; ++i)
            history.append(1ms * i, i % 2 == 0 ? std::numeric_limits<std::int32_t>::min()
                                               : std::numeric_limits<std::int32_t>::max());
        QVERIFY(alike(measure(history, 0s, 100s), plain(history, 0s, 100s)));
    }

    void noiseAndGapsMakeNoPeriods()
    {
        History noisy;
        appendSine(noisy, 8, 0, 400, 0, 4000, 40);
        QVERIFY(std::abs(measure(noisy, 0s, 4s).hertz.value_or(0) - 8) < 0.05);
        History gaps;
        appendSine(gaps, 10, 0, 400, 0, 1030); // ends within a period
        gaps.appendGap(1100ms);
        appendSine(gaps, 10, 0, 400, 3555, 1000);
        QVERIFY(std::abs(measure(gaps, 0s, 5s).hertz.value_or(0) - 10) < 0.02);
        History slow;
        appendSine(slow, 1, 0, 400, 0, 900); // less than a period
        QVERIFY(!measure(slow, 0s, 1s).hertz);
        History still;
        for (int i = 0; i < 100; ++i)
            still.append(1ms * i, 7);
        QVERIFY(!measure(still, 0s, 1s).hertz);
    }

    void endsThatMoveCostWhatTheyPass()
    {
        History history;
        appendSine(history, 5, 100, 3000, 0, 100'000);
        SpanMeasure moving;
        std::size_t budget = 1'000'000;
        moving.advance(history, 10s, 60s, budget);
        QVERIFY(moving.isDone());
        quint32 state = 3;
        for (int i = 0; i < 200; ++i) {
            state = state * 1664525U + 1013904223U;
            const LineTime from = 1ms * (state % 50'000);
            const LineTime to = 50s + 1ms * (state / 7 % 50'000);
            budget = 10'000'000;
            moving.advance(history, from, to, budget);
            QVERIFY(moving.isDone());
            QVERIFY(alike(moving.result(), plain(history, from, to)));
        }
        budget = 1'000'000;
        moving.advance(history, 20s, 70s, budget);
        std::size_t few = 10; // for the sums; the frequency then takes its time
        moving.advance(history, 20s + 5ms, 70s + 5ms, few);
        QCOMPARE(few, std::size_t(0));
        QVERIFY(alike(moving.result(), plain(history, 20s + 5ms, 70s + 5ms)));
        QVERIFY(moving.result().hertz);
    }

    void workIsBoundedEachTime()
    {
        History history;
        appendSine(history, 5, 100, 300, 0, 50'000);
        SpanMeasure slowly;
        int calls = 0;
        while (!slowly.isDone() && calls < 1000) {
            std::size_t budget = 1000;
            slowly.advance(history, 0s, 50s, budget);
            QVERIFY(budget <= 1000);
            ++calls;
        }
        QVERIFY(calls >= 100 && calls < 110); // twice each: sums, periods
        QVERIFY(slowly.result() == measure(history, 0s, 50s));
    }

    void liveItKeepsUp()
    {
        History history(5000); // and loses its oldest
        SpanMeasure live;
        bool hasHertz = false;
        for (int i = 0; i < 400; ++i) {
            appendSine(history, 5, 100, 300, 30 * i, 30);
            const LineTime now = history.last().at;
            std::size_t budget = 200;
            live.advance(history, now - 4s, now, budget);
            hasHertz = hasHertz || live.result().hertz;
        }
        QVERIFY(hasHertz);
        QVERIFY(std::abs(live.result().hertz.value_or(0) - 5) < 0.01);
        std::size_t budget = 100'000;
        const LineTime now = history.last().at;
        live.advance(history, now - 4s, now, budget);
        QVERIFY(alike(live.result(), plain(history, now - 4s, now)));
    }

    void anotherHistoryIsBegunAnew()
    {
        History history;
        appendSine(history, 5, 100, 300, 0, 1000);
        SpanMeasure one;
        std::size_t budget = 100'000;
        one.advance(history, 0s, 1s, budget);
        history = History(); // cleared, and filled again
        appendSine(history, 20, -100, 30, 0, 2000);
        budget = 100'000;
        one.advance(history, 0s, 2s, budget);
        QVERIFY(one.result() == measure(history, 0s, 2s));
    }
};

DYNASCOPE_CORE_TEST(TestSpanMeasure)
#include "tst_spanmeasure.moc"
