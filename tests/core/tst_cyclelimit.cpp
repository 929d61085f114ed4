// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/cyclelimit.h"
#include "tests/support/testmain.h"

#include <cmath>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

Traits traits(std::uint8_t id, std::chrono::microseconds delay = 0us)
{
    Traits result;
    result.id = id;
    result.returnDelay = delay;
    result.returnDelayKnown = true;
    return result;
}

/// Device 1 alone: four bytes at 132.
PollPlan oneRead(std::chrono::microseconds delay = 0us)
{
    return {AnyRate, {{1, {1, 132, 4}, 0ms}}, {traits(1, delay)}, {}};
}

bool isNear(double value, double wanted)
{
    return std::abs(value - wanted) <= wanted * 0.001;
}

} // namespace

/// By hand: bytes of request and answers × ten bits, 100 µs of thinking, Return Delay Time.
class TestCycleLimit : public QObject
{
    Q_OBJECT

private slots:
    void oneDevice_data()
    {
        QTest::addColumn<int>("baudRate");
        QTest::addColumn<int>("delay"); // µs
        QTest::addColumn<double>("cycle"); // µs
        QTest::newRow("1 Mbps") << 1'000'000 << 0 << (14 + 15) * 10.0 + 100;
        QTest::newRow("4 Mbps") << 4'000'000 << 0 << (14 + 15) * 2.5 + 100;
        QTest::newRow("factory delay") << 1'000'000 << 500 << (14 + 15) * 10.0 + 100 + 500;
    }

    void oneDevice()
    {
        QFETCH(int, baudRate);
        QFETCH(int, delay);
        QFETCH(double, cycle);
        const double rate = possibleCycleRate(oneRead(std::chrono::microseconds(delay)), baudRate);
        QVERIFY2(isNear(rate, 1e6 / cycle), qPrintable(QString::number(rate)));
    }

    void whatIsReadAtIntervalsTakesItsPart()
    {
        PollPlan plan = oneRead();
        plan.spans.push_back({1, {1, 64, 4}, 100ms}); // 390 µs ten times a second
        const double alone = possibleCycleRate(oneRead(), 1'000'000);
        QVERIFY(isNear(possibleCycleRate(plan, 1'000'000), alone * (1 - 0.0039)));
    }

    void nothingIsSaidWhereItCantBeKnown_data()
    {
        QTest::addColumn<QString>("what");
        for (const char *what : {"nothing is read", "only at intervals", "no time is left", "a delay isn't known"})
            QTest::newRow(what) << QString::fromLatin1(what);
    }

    void nothingIsSaidWhereItCantBeKnown()
    {
        QFETCH(QString, what);
        PollPlan plan = oneRead();
        if (what.startsWith(u"nothing"))
            plan.spans.clear();
        else if (what.startsWith(u"only"))
            plan.spans.front().interval = 10ms;
        else if (what.startsWith(u"no time"))
            plan.spans.push_back({1, {1, 0, 200}, 1ms}); // more than there is in a millisecond
        else
            plan.traits.front().returnDelayKnown = false;
        QCOMPARE(possibleCycleRate(plan, 1'000'000), 0.0);
    }
};

DYNASCOPE_CORE_TEST(TestCycleLimit)
#include "tst_cyclelimit.moc"
