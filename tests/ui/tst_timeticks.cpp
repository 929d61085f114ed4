// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/plot/timeticks.h"

using namespace dynascope;

class TestTimeTicks : public QObject
{
    Q_OBJECT

private slots:
    void steps_data();
    void steps();
    void labels_data();
    void labels();
};

void TestTimeTicks::steps_data()
{
    QTest::addColumn<double>("span");
    QTest::addColumn<int>("most");
    QTest::addColumn<double>("step");
    QTest::newRow("2 s") << 2.0 << 10 << 0.2;
    QTest::newRow("10 s") << 10.0 << 10 << 1.0;
    QTest::newRow("a minute") << 60.0 << 10 << 10.0;
    QTest::newRow("2 min: 15 s, as clocks do") << 120.0 << 10 << 15.0;
    QTest::newRow("5 min") << 300.0 << 10 << 30.0;
    QTest::newRow("10 min") << 600.0 << 10 << 60.0;
    QTest::newRow("10 min in a narrow panel") << 600.0 << 3 << 300.0;
    QTest::newRow("an hour") << 3600.0 << 10 << 600.0;
    QTest::newRow("a day") << 86400.0 << 10 << 10800.0;
    QTest::newRow("a week") << 604800.0 << 10 << 86400.0;
    QTest::newRow("a week in a narrow panel") << 604800.0 << 6 << 2 * 86400.0;
    QTest::newRow("a week in a very narrow panel") << 604800.0 << 1 << 7 * 86400.0;
    QTest::newRow("10 min in whole columns") << 600.000000285 << 10 << 60.0;
    QTest::newRow("10 s in whole columns") << 10.0000005 << 10 << 1.0;
    QTest::newRow("100 s in whole columns") << 100.00000285 << 10 << 10.0;
    QTest::newRow("room for none") << 10.0 << 0 << 10.0;
}

void TestTimeTicks::steps()
{
    QFETCH(double, span);
    QFETCH(int, most);
    QTEST(timeStep({-span, 0}, most), "step");
}

void TestTimeTicks::labels_data()
{
    QTest::addColumn<double>("at");
    QTest::addColumn<double>("step");
    QTest::addColumn<double>("from");
    QTest::addColumn<QString>("text");
    QTest::newRow("now") << 0.0 << 1.0 << -10.0 << QStringLiteral("0 s");
    QTest::newRow("seconds") << -8.0 << 1.0 << -10.0 << QStringLiteral("−8 s");
    QTest::newRow("parts of a second") << -0.4 << 0.2 << -2.0 << QStringLiteral("−0.4 s");
    QTest::newRow("nearly nothing is nothing") << -1e-9 << 0.2 << -2.0 << QStringLiteral("0.0 s");
    QTest::newRow("two minutes are seconds yet") << -105.0 << 15.0 << -120.0 << QStringLiteral("−105 s");
    QTest::newRow("two minutes in whole columns") << -105.0 << 15.0 << -120.0000006 << QStringLiteral("−105 s");
    QTest::newRow("minutes and seconds") << -90.0 << 30.0 << -300.0 << QStringLiteral("−1:30 min");
    QTest::newRow("a digit before") << -65.0 << 5.0 << -130.0 << QStringLiteral("−1:05 min");
    QTest::newRow("far from now, near to see") << -300.4 << 0.2 << -301.0 << QStringLiteral("−5:00.4 min");
    QTest::newRow("rounded up to the minute") << -299.99999 << 1.0 << -301.0 << QStringLiteral("−5:00 min");
    QTest::newRow("whole minutes") << -480.0 << 60.0 << -600.0 << QStringLiteral("−8 min");
    QTest::newRow("hours and minutes") << -8100.0 << 900.0 << -9000.0 << QStringLiteral("−2:15 h");
    QTest::newRow("hours, minutes, seconds") << -3665.0 << 5.0 << -3700.0 << QStringLiteral("−1:01:05 h");
    QTest::newRow("whole hours") << -86400.0 << 10800.0 << -90000.0 << QStringLiteral("−24 h");
    QTest::newRow("of a recording: from its beginning") << 90.0 << 30.0 << 300.0 << QStringLiteral("1:30 min");
}

void TestTimeTicks::labels()
{
    QFETCH(double, at);
    QFETCH(double, step);
    QFETCH(double, from);
    QTEST(timeLabel(at, step, {from, from < 0 ? 0 : from + 1}), "text");
}

DYNASCOPE_UI_TEST(TestTimeTicks)
#include "tst_timeticks.moc"
