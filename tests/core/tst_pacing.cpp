// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/pacing.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace std::chrono_literals;

/// Whether a served bus keeps the wire's pace is judged, said once, and taken back.
class TestPacing : public QObject
{
    Q_OBJECT

private slots:
    void figures()
    {
        Pacing pacing;
        QCOMPARE(pacing.report().replies, 0);
        for (int i = 1; i <= 100; ++i)
            pacing.handedOn(i * 1ms, i * 1ms + i * 10us);
        const Pacing::Report report = pacing.report();
        QCOMPARE(report.replies, 100);
        QCOMPARE(report.late, 0);
        QCOMPARE(report.median, LineTime(510us));
        QCOMPARE(report.percentile99, LineTime(1000us));
        QCOMPARE(report.worst, LineTime(1000us));
        QVERIFY(report.keepsUp);
    }

    void oneHiccupIsOnlyCounted()
    {
        Pacing pacing;
        for (int i = 0; i < 3000; ++i)
            pacing.handedOn(i * 1ms, i * 1ms + (i == 100 ? 30ms : 20us));
        QVERIFY(!pacing.news(3s));
        QCOMPARE(pacing.report().late, 1);
        QVERIFY(pacing.report().keepsUp);
    }

    void fallsBehindAndRecovers()
    {
        Pacing pacing;
        QStringList said;
        for (int i = 0; i < 8000; ++i) {
            const bool slow = i >= 2000 && i < 5000 && i % 10 == 0;
            pacing.handedOn(i * 1ms, i * 1ms + (slow ? 4ms : 20us));
            if (const auto news = pacing.news(i * 1ms))
                said.append(*news);
        }
        QCOMPARE(said.size(), 2);
        QVERIFY2(said[0].contains(QStringLiteral("does not keep up")), qPrintable(said[0]));
        QVERIFY2(said[0].contains(QStringLiteral("4.0 ms")), qPrintable(said[0]));
        QVERIFY2(said[1].contains(QStringLiteral("again")), qPrintable(said[1]));
        QVERIFY(pacing.report().keepsUp);
        QCOMPARE(pacing.report().late, 300);
    }

    /// A server that sleeps through its requests answers those that it hears on time.
    void requestsThatWereHeardLate()
    {
        Pacing pacing;
        for (int i = 0; i < 5; ++i)
            pacing.heardLate(120ms, i * 150ms);
        const auto news = pacing.news(2s);
        QVERIFY(news && news->contains(QStringLiteral("5 of 5 requests and replies were more than 1 ms late, the latest "
                                                      "by 120.0 ms")));
        QCOMPARE(pacing.report().replies, 0);
        QCOMPARE(pacing.report().late, 5);
    }

    void whatStopsWhileBehindIsJudgedByTheClock()
    {
        Pacing pacing;
        for (int i = 0; i < 10; ++i)
            pacing.handedOn(i * 1ms, i * 1ms + 50ms);
        QVERIFY(!pacing.news(100ms));
        QVERIFY(pacing.news(2s));
        QVERIFY(!pacing.report().keepsUp);
        QVERIFY(!pacing.news(3s)); // once
    }
};

DYNASCOPE_CORE_TEST(TestPacing)
#include "tst_pacing.moc"
