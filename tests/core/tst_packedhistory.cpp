// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// Samples as plain as they came, and what of them falls where.
struct Plain {
    std::vector<History::Sample> samples;
    std::vector<bool> gaps;

    std::size_t indexAt(LineTime at) const
    {
        return static_cast<std::size_t>(
            std::ranges::lower_bound(samples, at, {}, &History::Sample::at) - samples.begin());
    }
    Extremes extremes(std::size_t from, std::size_t to) const
    {
        Extremes result;
        for (std::size_t i = from; i < std::min(to, samples.size()); ++i)
            result.include(samples[i].raw);
        return result;
    }
    History::Column column(LineTime from, LineTime to) const
    {
        const std::size_t begin = indexAt(from);
        const std::size_t end = indexAt(to);
        if (begin == end)
            return {};
        const Extremes found = extremes(begin, end);
        return {found.minimum, found.maximum, samples[begin].raw, samples[end - 1].raw, false, gaps[begin]};
    }
};

/// A kind of times and values.
struct Style {
    const char *name;
    std::function<LineTime(std::mt19937_64 &)> step;
    std::function<std::int32_t(std::mt19937_64 &, int index)> value;
    int gapEach = 0; ///< one sample in so many; 0: none
};

const std::vector<Style> &styles()
{
    static const auto waving = [](std::mt19937_64 &random, int index) {
        return static_cast<std::int32_t>(2000 * std::sin(index * 0.003)) + static_cast<std::int32_t>(random() % 5);
    };
    static const auto anything = [](std::mt19937_64 &random, int) { return static_cast<std::int32_t>(random()); };
    static const std::vector<Style> all{
        {"jitter", [](auto &random) { return LineTime(1'000'000 + random() % 60'000); }, waving, 300},
        {"equal steps", [](auto &) { return LineTime(600'000); }, waving},
        {"bursts", [](auto &random) { return LineTime(random() % 40 == 0 ? 16'000'000 + random() % 999 : random() % 3); },
            waving, 40},
        {"any 32 bits", [](auto &random) { return LineTime(random() % 2'000'000); }, anything, 500},
        {"ends of the range", [](auto &random) { return LineTime(random() % 2'000'000); },
            [](auto &random, int) {
                return random() % 2 ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int32_t>::min();
            }},
        {"wrapping turns", [](auto &) { return 1ms; },
            [](auto &, int index) { return static_cast<std::int32_t>(static_cast<quint32>(index) * 700'000U); }},
        {"long pauses", [](auto &random) { return random() % 100 == 0 ? LineTime(random() % 360'000'000'000'000) : 1ms; },
            waving, 70},
        {"years", [](auto &random) { return LineTime(random() % 400'000'000'000'000); }, waving, 70},
        {"standing still", [](auto &) { return LineTime(0); }, [](auto &, int) { return -7; }, 3},
        {"a gap before each", [](auto &random) { return LineTime(random() % 9'000'000); }, waving, 1},
    };
    return all;
}

void fill(History &history, Plain &plain, const Style &style, int count, unsigned seed)
{
    std::mt19937_64 random(seed);
    LineTime now = style.name == QByteArrayView("years") ? -4'000'000'000s : 12345s;
    for (int i = 0; i < count; ++i) {
        now += style.step(random);
        const bool gap = i > 0 && style.gapEach > 0 && random() % static_cast<unsigned>(style.gapEach) == 0;
        if (gap)
            history.appendGap(now);
        const std::int32_t value = style.value(random, i);
        history.append(now, value);
        plain.samples.push_back({now, value});
        plain.gaps.push_back(gap);
    }
}

/// Parts of the time there was something, of all lengths, and beyond it.
struct Windows {
    std::mt19937_64 random{99};
    LineTime first, last;

    std::pair<LineTime, LineTime> next()
    {
        const auto whole = static_cast<std::uint64_t>((last - first).count()) + 1000;
        const std::uint64_t length = whole >> (random() % 24);
        const LineTime from = first - LineTime(100) + LineTime(static_cast<LineTime::rep>(random() % whole));
        return {from, from + LineTime(static_cast<LineTime::rep>(1 + random() % (length + 1)))};
    }
};

LineTime edge(LineTime from, LineTime to, std::size_t index, std::size_t count)
{
    const auto width = (to - from).count();
    const auto columns = static_cast<LineTime::rep>(count);
    const auto i = static_cast<LineTime::rep>(index);
    return from + LineTime(width / columns * i + width % columns * i / columns);
}

} // namespace

class TestPackedHistory : public QObject
{
    Q_OBJECT

private slots:
    void nothingIsLostByPacking_data() { addStyles(); }
    void nothingIsLostByPacking()
    {
        const Style &style = wanted();
        History history;
        Plain plain;
        fill(history, plain, style, 3 * 4096 + 777, 5);
        QCOMPARE(history.size(), plain.samples.size());
        for (std::size_t i = 0; i < plain.samples.size(); ++i) {
            if (history.at(i) != plain.samples[i] || history.gapBefore(i) != plain.gaps[i])
                QFAIL(qPrintable(QString::number(i)));
        }
        Windows windows{.first = plain.samples.front().at, .last = plain.samples.back().at};
        for (int i = 0; i < 150; ++i) {
            const auto [from, to] = windows.next();
            QCOMPARE(history.indexAt(from), plain.indexAt(from));
            std::vector<History::Column> columns(1 + windows.random() % 30);
            history.columns(from, to, columns);
            for (std::size_t k = 0; k < columns.size(); ++k)
                QVERIFY(columns[k] == plain.column(edge(from, to, k, columns.size()), edge(from, to, k + 1, columns.size())));
        }
    }

    void foldingKeepsTheEnvelope_data() { addStyles(); }
    void foldingKeepsTheEnvelope()
    {
        const Style &style = wanted();
        History history;
        Plain plain;
        fill(history, plain, style, 9 * 4096 + 777, 6);
        for (const Detail detail : {Detail::Samples, Detail::Samples, Detail::Samples, Detail::Samples, Detail::Samples,
                 Detail::Fine, Detail::Fine, Detail::Fine, Detail::Coarse})
            history.foldOldest(detail); // chunk 0 whole, 1 and 2 coarse, 3 and 4 fine
        const std::size_t folded = plain.samples.size() - history.size();
        QCOMPARE(folded, Folded);
        for (std::size_t i = 0; i < history.size(); i += 11)
            QVERIFY(history.at(i) == plain.samples[folded + i]);
        Windows windows{.first = plain.samples.front().at, .last = plain.samples.back().at};
        for (int i = 0; i < 400; ++i) {
            const auto [from, to] = windows.next();
            compareFolded(history, plain, from, to, 1 + windows.random() % 30, style.gapEach > 0);
            if (QTest::currentTestFailed())
                return;
        }
    }

    void atLastItGoes()
    {
        History history;
        Plain plain;
        fill(history, plain, styles().front(), 3 * 4096 + 10, 7);
        const LineTime begin = plain.samples.front().at;
        const LineTime end = plain.samples.back().at + 1ns;
        for (const Detail detail : {Detail::Samples, Detail::Fine, Detail::Coarse}) {
            QVERIFY(history.oldest(detail));
            history.foldOldest(detail);
            std::int32_t least = 0, most = 0;
            QVERIFY(history.range(begin, end, least, most));
            QVERIFY((Extremes{least, most} == plain.extremes(0, plain.samples.size())));
        }
        QVERIFY(history.isFolded(begin, end));
        QCOMPARE(history.oldest(Detail::Whole), std::optional(begin));
        history.foldOldest(Detail::Whole);
        QVERIFY(!history.isFolded(begin, end));
        QVERIFY(!history.oldest(Detail::Whole));
        std::vector<History::Column> columns(1);
        history.columns(begin, history.at(0).at, columns);
        QVERIFY(columns[0].isEmpty);
        for (const Detail detail : {Detail::Fine, Detail::Coarse, Detail::Whole})
            history.foldOldest(detail); // there is none
        QCOMPARE(history.size(), std::size_t(2 * 4096 + 10));
        QCOMPARE(history.appended(), std::uint64_t(3 * 4096 + 10));
    }

    void aPauseStaysAGapWhenFolded()
    {
        History history;
        for (int i = 0; i < 3 * 4096; ++i) {
            if (i == 1000 || i == 4096) // in a block; at the border of two chunks
                history.appendGap(LineTime(1ms) * i);
            history.append(1ms * i + (i >= 1000 ? 10s : 0s) + (i >= 4096 ? 10s : 0s), i);
        }
        for (const Detail detail : {Detail::Samples, Detail::Fine, Detail::Coarse, Detail::Samples}) {
            history.foldOldest(detail);
            std::vector<History::Column> columns(34); // of a second
            history.columns(0s, 34s, columns);
            QVERIFY(!columns[0].isEmpty && !columns[0].gapBefore);
            for (std::size_t i = 0; i < columns.size(); ++i)
                QCOMPARE(columns[i].isEmpty, (i > 0 && i < 11) || (i > 14 && i < 24) || i > 32);
            QVERIFY(!columns[11].isEmpty && columns[11].gapBefore);
            QVERIFY(!columns[12].isEmpty && !columns[12].gapBefore);
            QVERIFY(!columns[24].isEmpty);
            QVERIFY(columns[24].gapBefore);
        }
    }

    void linesFromWhatWasFoldedMoveLeast()
    {
        History history;
        for (int i = 0; i < 2 * 4096 + 1; ++i)
            history.append(1ms * i, i < 2048 ? 100 : i < 4096 ? 500 + i % 2 : 100);
        history.foldOldest(Detail::Samples);
        std::vector<History::Column> columns(6);
        history.columns(0s, 1ms * 6144, columns); // a border at 2048, one at 4096
        QVERIFY((columns[0] == History::Column{100, 100, 100, 100, false, false}));
        QVERIFY((columns[2] == History::Column{100, 501, 100, 100, false, false})); // with the block before it
        QVERIFY((columns[3] == History::Column{500, 501, 500, 500, false, false}));
        QVERIFY((columns[4] == History::Column{100, 100, 100, 100, false, false}));
    }

private:
    static constexpr std::size_t Folded = std::size_t(5) * 4096;

    static std::size_t blockSize(std::size_t index)
    {
        return index >= Folded ? 1 : index >= 3 * 4096 ? 16 : index >= 4096 ? 256 : 4096;
    }
    static std::size_t blockOf(std::size_t index) { return index / blockSize(index) * blockSize(index); }

    static void compareFolded(
        const History &history, const Plain &plain, LineTime from, LineTime to, std::size_t count, bool hasGaps)
    {
        std::vector<History::Column> columns(count);
        history.columns(from, to, columns);
        Extremes all;
        for (std::size_t k = 0; k < count; ++k) {
            const LineTime start = edge(from, to, k, count);
            const LineTime stop = edge(from, to, k + 1, count);
            const History::Column &column = columns[k];
            const History::Column exact = plain.column(start, stop);
            if (start >= plain.samples[Folded].at || stop <= plain.samples.front().at || start == stop) {
                QVERIFY(column == exact);
                continue;
            }
            const std::size_t begin = plain.indexAt(start);
            const std::size_t end = plain.indexAt(stop);
            const Extremes blocks = plain.extremes(
                begin > 0 ? blockOf(begin - 1) : 0, end > 0 ? blockOf(end - 1) + blockSize(end - 1) : 0);
            const Extremes found{column.minimum, column.maximum};
            QVERIFY(hasGaps || !column.isEmpty);
            if (!exact.isEmpty)
                QVERIFY(!column.isEmpty && found.covers({exact.minimum, exact.maximum})); // nothing is lost
            if (!column.isEmpty) {
                QVERIFY(found.covers({column.first, column.first}) && found.covers({column.last, column.last}));
                QVERIFY(hasGaps ? blocks.covers(found) : blocks == found); // and nothing is invented
                all.include(found);
            }
        }
        std::int32_t least = 0, most = 0;
        QVERIFY(history.range(from, to, least, most) || all.isEmpty());
        QVERIFY(all.isEmpty() || (Extremes{least, most}.covers(all)));
    }

    static void addStyles()
    {
        QTest::addColumn<int>("style");
        for (std::size_t i = 0; i < styles().size(); ++i)
            QTest::newRow(styles()[i].name) << static_cast<int>(i);
    }
    static const Style &wanted()
    {
        QFETCH(int, style);
        return styles()[static_cast<std::size_t>(style)];
    }
};

DYNASCOPE_CORE_TEST(TestPackedHistory)
#include "tst_packedhistory.moc"
