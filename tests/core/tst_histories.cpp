// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/histories.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

quint64 s_allocations = 0;
std::size_t s_allocated = 0; ///< bytes, what the heap takes for itself included

} // namespace

void *operator new(std::size_t size)
{
    ++s_allocations;
    if (void *memory = std::malloc(size > 0 ? size : 1)) {
        s_allocated += malloc_usable_size(memory) + sizeof(std::size_t);
        return memory;
    }
    throw std::bad_alloc();
}

/// std::stable_sort asks by this one, and gives back by the one below.
void *operator new(std::size_t size, const std::nothrow_t &) noexcept
try {
    return operator new(size);
} catch (const std::bad_alloc &) {
    return nullptr;
}

void operator delete(void *memory) noexcept
{
    if (memory)
        s_allocated -= malloc_usable_size(memory) + sizeof(std::size_t);
    std::free(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
    operator delete(memory);
}

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// 20 fields of 4 devices, each device's in replies of its own.
struct Replies {
    static constexpr quint32 Devices = 4;
    static constexpr int Fields = 5;

    Histories &histories;
    std::mt19937 random{7};
    LineTime now = 1h;
    std::array<int, Fields> values{};

    void cycle()
    {
        for (quint32 device = 1; device <= Devices; ++device) {
            now += LineTime(200'000 + random() % 30'000);
            for (int field = 0; field < Fields; ++field) {
                int &value = values[static_cast<std::size_t>(field)];
                value += static_cast<int>(random() % 9) - 4;
                histories.append({device, field}, now, value);
            }
        }
    }
};

std::size_t samplesOf(const Histories &histories)
{
    std::size_t count = 0;
    for (quint32 device = 1; device <= Replies::Devices; ++device) {
        for (int field = 0; field < Replies::Fields; ++field)
            count += histories.find({device, field})->size();
    }
    return count;
}

} // namespace

class TestHistories : public QObject
{
    Q_OBJECT

private slots:
    void theBudgetIsKept()
    {
        constexpr std::size_t Budget = 3 << 20;
        Histories histories(Budget);
        Replies replies{histories};
        std::size_t most = 0;
        for (int i = 0; i < 100'000; ++i) {
            replies.cycle();
            most = std::max(most, histories.used());
        }
        QVERIFY2(most <= Budget, qPrintable(QString::number(most)));
        QVERIFY(most > Budget * 95 / 100); // nor is it wasted
        const History &history = *histories.find({2, 3});
        QCOMPARE(history.appended(), std::uint64_t(100'000));
        QVERIFY(history.size() > 10'000 && history.size() < 90'000);
        QVERIFY(history.oldest(Detail::Fine) && history.oldest(Detail::Samples));
        // All of them reach back equally far.
        for (quint32 device = 1; device <= Replies::Devices; ++device) {
            for (int field = 0; field < Replies::Fields; ++field)
                QVERIFY(std::abs(static_cast<long long>(histories.find({device, field})->size() - history.size())) <= 4096);
        }
    }

    void whatIsCountedIsWhatIsAllocated()
    {
        if (test::Sanitized)
            QSKIP("The sanitizers' heap counts what was asked for, not what is taken");
        const std::size_t before = s_allocated;
        Histories histories(5 << 20);
        Replies replies{histories};
        for (const int cycles : {20'000, 100'000}) { // none folded yet; much
            for (int i = 0; i < cycles; ++i)
                replies.cycle();
            const auto allocated = static_cast<double>(s_allocated - before);
            const auto counted = static_cast<double>(histories.used());
            QVERIFY2(allocated < counted * 1.02 && allocated > counted * 0.97,
                qPrintable(QStringLiteral("%1 counted, %2 allocated").arg(counted).arg(allocated)));
        }
        histories.erase([](const Watch &watch) { return watch.device < 3; });
        QVERIFY(static_cast<double>(s_allocated - before) < static_cast<double>(histories.used()) * 1.04);
        histories.clear();
        QCOMPARE(histories.used(), std::size_t(0));
    }

    void aSmallerBudgetIsKeptAtOnce()
    {
        Histories histories;
        Replies replies{histories};
        for (int i = 0; i < 30'000; ++i)
            replies.cycle();
        QCOMPARE(samplesOf(histories), std::size_t(20 * 30'000));
        histories.setBudget(1 << 20);
        QVERIFY(histories.used() <= 1 << 20);
        QVERIFY(samplesOf(histories) < 20 * 30'000);
        histories.setBudget(1); // the newest stay
        QVERIFY(samplesOf(histories) > 20 * 1000);
        QVERIFY(samplesOf(histories) <= 20 * 4096);
        QVERIFY(!histories.find({1, 1})->isFolded(0s, 2h));
        replies.cycle();
        QCOMPARE(histories.find({4, 1})->last().at, replies.now);
    }

    void fieldsOfOneReplyShareTheirTimes()
    {
        // The same values and times, once as one device's fields, once as fields of as many devices with other times.
        Histories together;
        Histories apart;
        std::mt19937 random(3);
        LineTime now = 1s;
        for (int i = 0; i < 50'000; ++i) {
            now += LineTime(1'000'000 + random() % 100'000);
            for (int field = 0; field < 6; ++field) {
                if (field == 4 && i < 1234)
                    continue; // comes later, and stands beside the others all the same
                together.append({1, field}, now, i % 100);
                apart.append({static_cast<quint32>(field + 1), 0}, now + LineTime(random() % 100'000), i % 100);
            }
        }
        QVERIFY(together.used() + 450'000 < apart.used()); // some 2 bytes a time, five times
        QCOMPARE(together.find({1, 4})->appended(), std::uint64_t(50'000 - 1234));
        QCOMPARE(together.find({1, 4})->size(), std::size_t(50'000 - 1234));
        for (std::size_t i = 0; i < 50'000 - 1234; i += 7) {
            QCOMPARE(together.find({1, 4})->at(i), (History::Sample{together.find({1, 0})->at(i + 1234).at,
                                                       static_cast<int>((i + 1234) % 100)}));
        }
    }

    void aSampleAllocatesNothing()
    {
        Histories histories;
        Replies replies{histories};
        for (int i = 0; i < 2 * 4096 + 2049; ++i)
            replies.cycle();
        const quint64 warm = s_allocations;
        for (int i = 0; i < 2047; ++i)
            replies.cycle();
        QCOMPARE(s_allocations, warm);
        for (int i = 0; i < 4096; ++i) // 20 chunks are packed, and as many take room again, bit by bit
            replies.cycle();
        QVERIFY(s_allocations > warm && s_allocations < warm + 20 * 24);
    }

    void aShortHistoryIsASmallOne_data()
    {
        QTest::addColumn<int>("cycles");
        QTest::addColumn<double>("bytes"); // a sample, at most
        QTest::newRow("a few") << 200 << 60.0;
        QTest::newRow("half a chunk") << 2048 << 16.0;
        QTest::newRow("a chunk and the first of the next") << 4097 << 5.0;
        QTest::newRow("ten thousand") << 10'000 << 6.0;
        QTest::newRow("the third chunk full") << 3 * 4096 << 6.5;
    }
    void aShortHistoryIsASmallOne()
    {
        QFETCH(const int, cycles);
        QFETCH(const double, bytes);
        Histories histories;
        Replies replies{histories};
        for (int i = 0; i < cycles; ++i)
            replies.cycle();
        const double each = static_cast<double>(histories.used()) / static_cast<double>(samplesOf(histories));
        QVERIFY2(each <= bytes, qPrintable(QString::number(each)));
    }

    void aGapBeforeTheFirstSampleMakesNoHistory()
    {
        Histories histories;
        histories.appendGap({1, 1}, 1s);
        QVERIFY(!histories.find({1, 1}));
        histories.append({1, 1}, 2s, 5);
        histories.appendGap({1, 1}, 3s);
        histories.append({1, 1}, 4s, 6);
        QVERIFY(!histories.find({1, 1})->gapBefore(0) && histories.find({1, 1})->gapBefore(1));
        histories.clear();
        QVERIFY(histories.find({1, 1})->isEmpty());
        histories.erase([](const Watch &) { return true; });
        QVERIFY(!histories.find({1, 1}));
    }
};

DYNASCOPE_CORE_TEST(TestHistories)
#include "tst_histories.moc"
