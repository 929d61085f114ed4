// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history.h"
#include "tests/support/testmain.h"

#include <QRandomGenerator>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// The same, kept as plainly as possible: what History is compared with.
struct Plain {
    struct Entry {
        History::Sample sample;
        bool gapBefore = false;
    };
    std::vector<Entry> entries;
    std::size_t capacity = History::DefaultCapacity;
    bool gap = false;

    void append(LineTime at, std::int32_t raw)
    {
        if (!entries.empty() && at < entries.back().sample.at)
            return;
        entries.push_back({{at, raw}, gap});
        gap = false;
        if (entries.size() > capacity)
            entries.erase(entries.begin());
    }

    void appendGap() { gap = !entries.empty(); }

    History::Column column(LineTime from, LineTime to) const
    {
        History::Column column;
        for (const Entry &entry : entries) {
            if (entry.sample.at < from || entry.sample.at >= to)
                continue;
            const std::int32_t raw = entry.sample.raw;
            if (column.isEmpty)
                column = {raw, raw, raw, raw, false, entry.gapBefore};
            column.minimum = std::min(column.minimum, raw);
            column.maximum = std::max(column.maximum, raw);
            column.last = raw;
        }
        return column;
    }

    bool range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const
    {
        bool found = false;
        const auto include = [&](std::int32_t raw) {
            minimum = found ? std::min(minimum, raw) : raw;
            maximum = found ? std::max(maximum, raw) : raw;
            found = true;
        };
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const LineTime at = entries[i].sample.at;
            if (at >= from && at < to)
                include(entries[i].sample.raw);
            if (i == 0 || entries[i].gapBefore || at < from || entries[i - 1].sample.at >= to)
                continue;
            include(entries[i - 1].sample.raw); // a line from the sample before shows in the stretch
            include(entries[i].sample.raw);
        }
        return found;
    }
};

struct Pair {
    History history;
    Plain plain;

    explicit Pair(std::size_t capacity) : history(capacity) { plain.capacity = capacity; }

    void append(LineTime at, std::int32_t raw)
    {
        history.append(at, raw);
        plain.append(at, raw);
    }

    void appendGap(LineTime at)
    {
        history.appendGap(at);
        plain.appendGap();
    }
};

void compareColumns(const Pair &pair, LineTime from, LineTime width, std::size_t count)
{
    std::vector<History::Column> columns(count);
    pair.history.columns(from, from + width * static_cast<int>(count), columns);
    for (std::size_t i = 0; i < count; ++i) {
        const LineTime start = from + width * static_cast<int>(i);
        const History::Column expected = pair.plain.column(start, start + width);
        if (columns[i] != expected) {
            qWarning("column %zu of %zu from %lld: %d..%d, not %d..%d", i, count, static_cast<long long>(from.count()),
                columns[i].minimum, columns[i].maximum, expected.minimum, expected.maximum);
        }
        QVERIFY(columns[i] == expected);
    }
}

} // namespace

class TestHistory : public QObject
{
    Q_OBJECT

private slots:
    void emptyHasNothing()
    {
        const History history;
        QVERIFY(history.isEmpty());
        std::int32_t minimum = 7;
        std::int32_t maximum = 8;
        QVERIFY(!history.range(0s, 10s, minimum, maximum));
        QCOMPARE(minimum, 7);
        std::vector<History::Column> columns(3, {1, 2, 1, 2, false, true});
        history.columns(0s, 3s, columns);
        for (const History::Column &column : columns)
            QVERIFY(column == History::Column{});
        QCOMPARE(history.indexAt(1s), std::size_t(0));
    }

    void keepsOrder()
    {
        History history;
        history.append(2s, 20);
        history.append(1s, 10);
        history.append(2s, 21);
        QCOMPARE(history.size(), std::size_t(2));
        QVERIFY((history.at(0) == History::Sample{2s, 20}));
        QVERIFY((history.last() == History::Sample{2s, 21}));
        QCOMPARE(history.indexAt(2s), std::size_t(0));
        QCOMPARE(history.indexAt(3s), std::size_t(2));
    }

    void forgetsTheOldest()
    {
        History history(10'000);
        for (int i = 0; i < 100'000; ++i)
            history.append(LineTime(i), i);
        QCOMPARE(history.size(), std::size_t(10'000));
        QCOMPARE(history.appended(), std::uint64_t(100'000));
        for (std::size_t i = 0; i < 10'000; ++i)
            QCOMPARE(history.at(i).raw, 90'000 + static_cast<int>(i));
        QCOMPARE(history.indexAt(LineTime(5)), std::size_t(0));
        std::int32_t minimum = 0;
        std::int32_t maximum = 0;
        QVERIFY(history.range(LineTime(0), LineTime(200'000), minimum, maximum));
        QCOMPARE(minimum, 90'000);
        QCOMPARE(maximum, 99'999);
    }

    void gapsBelongToTheNextSample()
    {
        History history;
        history.appendGap(0s); // before anything is known there is nothing to interrupt
        history.append(1s, 1);
        history.append(2s, 2);
        history.appendGap(3s);
        history.appendGap(4s);
        history.append(5s, 5);
        history.append(6s, 6);
        QVERIFY(!history.gapBefore(0) && !history.gapBefore(1) && history.gapBefore(2) && !history.gapBefore(3));
        std::int32_t minimum = 0;
        std::int32_t maximum = 0;
        QVERIFY(!history.range(3s, 5s, minimum, maximum)); // no line crosses the gap
        QVERIFY(history.range(5s + 1ns, 6s, minimum, maximum));
        QCOMPARE(minimum, 5);
        QCOMPARE(maximum, 6);
    }

    void agreesWithPlainSearch_data()
    {
        QTest::addColumn<int>("samples");
        QTest::addColumn<int>("capacity");
        QTest::addColumn<int>("pauses"); ///< one in so many samples comes after a long pause; 0: never
        QTest::newRow("one") << 1 << 100 << 0;
        QTest::newRow("fewer than a block") << 13 << 100 << 3;
        QTest::newRow("one chunk") << 4096 << 5000 << 0;
        QTest::newRow("several chunks") << 15'000 << 20'000 << 500;
        QTest::newRow("evicted inside a chunk") << 15'000 << 6'001 << 200;
        QTest::newRow("evicted, tiny") << 9'000 << 7 << 4;
    }

    void agreesWithPlainSearch()
    {
        QFETCH(int, samples);
        QFETCH(int, capacity);
        QFETCH(int, pauses);
        QRandomGenerator random(static_cast<quint32>(samples + capacity));
        Pair pair(static_cast<std::size_t>(capacity));
        std::int64_t now = 1000;
        for (int i = 0; i < samples; ++i) {
            now += random.bounded(0, 20); // equal times do happen
            if (pauses > 0 && random.bounded(pauses) == 0)
                now += 3000;
            if (random.bounded(50) == 0)
                pair.appendGap(LineTime(now));
            if (random.bounded(70) == 0)
                pair.append(LineTime(now - 500), 1'000'000); // late: dropped
            pair.append(LineTime(now), random.bounded(-5000, 5000));
        }
        QCOMPARE(pair.history.size(), pair.plain.entries.size());
        QCOMPARE(pair.history.gapBefore(0), pair.plain.entries.front().gapBefore);
        for (const int width : {1, 17, 800, 60'000}) {
            for (int i = 0; i < 3; ++i)
                compareColumns(pair, LineTime(random.bounded(static_cast<int>(now) + 100)), LineTime(width), 40);
        }
        compareColumns(pair, LineTime(0), LineTime(now / 100 + 1), 101);
        for (int i = 0; i < 200; ++i) {
            const LineTime from(random.bounded(static_cast<int>(now) + 100));
            const LineTime to = from + LineTime(random.bounded(1, 1 << random.bounded(1, 17)));
            std::int32_t minimum = 0, maximum = 0, plainMinimum = 0, plainMaximum = 0;
            const bool found = pair.history.range(from, to, minimum, maximum);
            QCOMPARE(found, pair.plain.range(from, to, plainMinimum, plainMaximum));
            QCOMPARE(minimum, plainMinimum);
            QCOMPARE(maximum, plainMaximum);
        }
    }

    void columnsOfAnyLength()
    {
        History history;
        for (int i = 0; i < 1000; ++i)
            history.append(std::chrono::seconds(i), i);
        std::vector<History::Column> columns(7); // 1000 s don't divide by seven: nothing may be lost or seen twice
        history.columns(0s, 1000s, columns);
        int next = 0;
        for (const History::Column &column : columns) {
            QCOMPARE(column.first, next);
            next = column.last + 1;
        }
        QCOMPARE(next, 1000);
    }

    void canBeMoved()
    {
        History history;
        history.append(1s, 1);
        History other = std::move(history);
        QCOMPARE(other.size(), std::size_t(1));
        other = History();
        QVERIFY(other.isEmpty());
        other.append(0s, 5);
        QCOMPARE(other.last().raw, 5);
    }
};

DYNASCOPE_CORE_TEST(TestHistory)
#include "tst_history.moc"
