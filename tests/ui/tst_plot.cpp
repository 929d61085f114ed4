// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/traces.h"
#include "ui/plot/columncache.h"
#include "ui/plot/plotscales.h"
#include "ui/plot/timewindow.h"

#include <QRandomGenerator>

using namespace dynascope;

/// What a plot shows: axes, the stretch of time, the columns.
class TestPlot : public QObject
{
    Q_OBJECT

private slots:
    void stepsAreRound_data()
    {
        QTest::addColumn<double>("span");
        QTest::addColumn<int>("most");
        QTest::addColumn<bool>("angle");
        QTest::addColumn<double>("step");
        QTest::newRow("one") << 1.0 << 10 << false << 0.1;
        QTest::newRow("between") << 1.3 << 10 << false << 0.2;
        QTest::newRow("hundreds") << 2500.0 << 6 << false << 500.0;
        QTest::newRow("small") << 0.003 << 5 << false << 0.001;
        QTest::newRow("a turn") << 360.0 << 6 << true << 90.0;
        QTest::newRow("a quarter") << 90.0 << 6 << true << 15.0;
        QTest::newRow("few degrees") << 4.0 << 5 << true << 1.0;
        QTest::newRow("nothing") << 0.0 << 5 << false << 1.0;
    }

    void stepsAreRound()
    {
        QFETCH(double, span);
        QFETCH(int, most);
        QFETCH(bool, angle);
        QTEST(niceStep(span, most, angle), "step");
    }

    void labelsTellStepsApart()
    {
        QCOMPARE(decimalsFor(5), 0);
        QCOMPARE(decimalsFor(1), 0);
        QCOMPARE(decimalsFor(0.5), 1);
        QCOMPARE(decimalsFor(0.1), 1);
        QCOMPARE(decimalsFor(0.002), 3);
    }

    void axisFollowsAtOnceAndShrinksLate()
    {
        AxisScaler axis(1);
        axis.fit(0, 100, 0s);
        QVERIFY(axis.range().minimum <= 0 && axis.range().maximum >= 100);
        QVERIFY(axis.range().span() < 160);
        const AxisRange first = axis.range();
        axis.fit(2, 97, 1s); // breathing moves nothing
        QCOMPARE(axis.range(), first);
        axis.fit(0, 150, 1s);
        QVERIFY(axis.range().maximum >= 150);
        QCOMPARE(axis.range().minimum, first.minimum); // the side that wasn't left stays
        const AxisRange grown = axis.range();
        axis.fit(50, 60, 2s);
        axis.fit(50, 60, 2s + AxisScaler::Patience / 2);
        QCOMPARE(axis.range(), grown);
        axis.fit(0, 150, 3s); // wide again in between: the waiting begins anew
        axis.fit(50, 60, 4s);
        axis.fit(50, 60, 4s + AxisScaler::Patience / 2);
        QCOMPARE(axis.range(), grown);
        axis.fit(50, 60, 4s + AxisScaler::Patience);
        QVERIFY(axis.range().span() < 20);
    }

    void restingValueDoesNotFillTheAxis()
    {
        AxisScaler axis(10);
        axis.fit(42, 42, 0s);
        QVERIFY(axis.range().span() >= 10);
        QVERIFY(axis.range().minimum < 42 && axis.range().maximum > 42);
        axis.setRange(1, 1); // nothing sensible
        QVERIFY(axis.range().span() >= 10);
    }

    void axesByUnit()
    {
        History position;
        History current;
        position.append(1s, 100);
        current.append(1s, -7);
        std::vector traces{
            traceOf(position, QStringLiteral("°")), traceOf(current), traceOf(position, QStringLiteral("°"))};
        traces[0].scale = 0.5;
        PlotScales scales;
        scales.setTraces(traces);
        scales.fit(traces, secondsPerColumn(10), 1s);
        QCOMPARE(scales.scales().size(), std::size_t(2));
        QCOMPARE(scales.labelled(0)->unit, QStringLiteral("°"));
        QCOMPARE(scales.labelled(1)->unit, QStringLiteral("mA"));
        const AxisRange &range = scales.range(QStringLiteral("°"));
        QVERIFY(range.minimum < 50 && range.maximum > 100);
        QVERIFY(scales.range(QStringLiteral("mA")).maximum < 50);
        traces[0].visible = traces[2].visible = false;
        scales.setTraces(traces);
        QCOMPARE(scales.labelled(0)->unit, QStringLiteral("mA"));
        QCOMPARE(scales.labelled(1), nullptr);
    }

    void spanHasLimits()
    {
        TimeWindow window;
        window.setSpan(0s);
        QCOMPARE(window.span(), TimeWindow::ShortestSpan);
        window.setSpan(1h);
        QCOMPARE(window.span(), TimeWindow::LongestSpan);
        window.setSpan(20s);
        const TimeView view = window.view(1000, 500s);
        QCOMPARE(view.columns, 1000);
        QVERIFY(view.to() > 500s && view.to() - view.step <= 500s); // the newest sample is in the last column
        QVERIFY(view.to() - view.from() >= 20s);
        QVERIFY(view.to() - view.from() < 21s);
    }

    void liveViewMovesByWholeColumns()
    {
        const TimeWindow window;
        const TimeView one = window.view(777, 100s);
        const TimeView other = window.view(777, 100s + 1234567ns);
        QCOMPARE(one.step, other.step);
        QCOMPARE((other.from() - one.from()) % one.step, 0ns);
    }

    void pausedViewStandsMovesAndZooms()
    {
        TimeWindow window;
        window.setSpan(10s);
        window.pause(100s);
        const TimeView still = window.view(1000, 100s);
        QVERIFY(still == window.view(1000, 200s));
        window.pan(-20s);
        const TimeView moved = window.view(1000, 200s);
        QVERIFY(moved.from() < 71s && moved.from() > 69s);
        window.zoom(0.5, 75s);
        const TimeView zoomed = window.view(1000, 200s);
        const double share = zoomed.column(75s) / zoomed.columns;
        QVERIFY(std::abs(share - 0.5) < 0.01); // what was under the mouse stays there
        window.zoom(1e9, 75s);
        const TimeView wide = window.view(1000, 0s);
        QVERIFY(wide.to() - wide.from() <= TimeWindow::LongestZoom + wide.step * 1000);
        window.setLive();
        QVERIFY(window.view(1000, 200s).to() > 200s);
    }

    void cachedColumnsAreThoseOfTheHistory()
    {
        QRandomGenerator random(7);
        History history(5000);
        ColumnCache cache;
        std::int64_t now = 1'000'000;
        std::int64_t first = 0;
        for (int frame = 0; frame < 400; ++frame) {
            if (frame == 200)
                history = History(5000); // cleared
            for (int i = random.bounded(40); i > 0; --i) {
                now += random.bounded(1, 200);
                if (random.bounded(60) == 0)
                    history.appendGap(LineTime(now));
                history.append(LineTime(now), random.bounded(-1000, 1000));
            }
            TimeView view{LineTime(frame < 300 ? 97 : 131), 0, 300, {}};
            first = now / view.step.count() - 299;
            view.firstColumn = frame % 50 == 49 ? first - 120 : first; // now and then back
            std::vector<History::Column> expected(300);
            history.columns(view.from(), view.to(), expected);
            const auto columns = cache.columns(history, view);
            QVERIFY(std::equal(columns.begin(), columns.end(), expected.begin(), expected.end()));
        }
    }
};

DYNASCOPE_UI_TEST(TestPlot)
#include "tst_plot.moc"
