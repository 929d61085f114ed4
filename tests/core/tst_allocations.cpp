// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"
#include "tests/support/nullline.h"
#include "tests/support/testmain.h"

#include <cstdlib>
#include <new>

namespace {

thread_local quint64 s_allocations = 0;

} // namespace

void *operator new(std::size_t size)
{
    ++s_allocations;
    if (void *memory = std::malloc(size > 0 ? size : 1))
        return memory;
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
    std::free(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
    std::free(memory);
}

using namespace dynascope;
using namespace std::chrono_literals;

/// Polling at the speed of the wire leaves the heap alone: a cycle like those before allocates nothing.
class TestAllocations : public QObject
{
    Q_OBJECT

private slots:
    void aCycleAllocatesNothing_data()
    {
        QTest::addColumn<bool>("fast");
        QTest::addColumn<bool>("group");
        QTest::newRow("fast") << true << true;
        QTest::newRow("sync") << false << true;
        QTest::newRow("single") << false << false;
    }

    void aCycleAllocatesNothing()
    {
        QFETCH(bool, fast);
        QFETCH(bool, group);
        NullLine line;
        Bus bus(line);
        Poller poller(bus);
        poller.setPlan(nullPlan(12, 10, fast, group));
        Batch batch;
        const quint64 before = s_allocations;
        for (int cycle = 0; cycle < 20; ++cycle)
            QVERIFY(poller.runCycle(batch));
        const quint64 warm = s_allocations;
        QVERIFY(warm > before); // the counter counts
        for (int cycle = 0; cycle < 1000; ++cycle) {
            const Result<void> done = poller.runCycle(batch);
            if (!done || batch.values.back().data.size() != 10)
                QFAIL("a value is missing");
        }
        QCOMPARE(s_allocations, warm);
    }
};

DYNASCOPE_CORE_TEST(TestAllocations)
#include "tst_allocations.moc"
