// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/plot/plotexport.h"
#include "ui/plot/plotscales.h"
#include "ui/plot/plotstate.h"
#include "ui/plot/timewindow.h"
#include "ui/plot/traceimage.h"

#include <QBuffer>
#include <QRandomGenerator>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr QRgb Red = 0xFFFF0000;

TraceData traceOf(const History &history, const QString &unit = QStringLiteral("mA"))
{
    TraceData trace;
    trace.history = &history;
    trace.unit = unit;
    trace.color = QColor::fromRgb(Red);
    trace.label = QStringLiteral("servo");
    return trace;
}

/// The rows of a picture as text: '#' painted, '+' partly, '.' not.
QStringList asText(const QImage &image)
{
    QStringList lines;
    for (int y = 0; y < image.height(); ++y) {
        QString line;
        for (int x = 0; x < image.width(); ++x) {
            const int alpha = qAlpha(image.pixel(x, y));
            line += alpha > 200 ? u'#' : alpha > 20 ? u'+' : u'.';
        }
        lines.append(line);
    }
    return lines;
}

QStringList painted(const TraceData &trace, const TimeView &view, const AxisRange &range, int height)
{
    TraceImage image;
    const TraceImage::Item item{&trace, &range, 1.0F, false};
    return asText(image.paint({&item, 1}, view, height));
}

/// Where two pictures differ by more than rounding; empty where they don't. But for the first columns: a picture
/// that begins there knows less of what lies to its left.
QString difference(const QImage &one, const QImage &other)
{
    QString text;
    for (int x = 4; x < one.width(); ++x) {
        int count = 0;
        for (int y = 0; y < one.height(); ++y)
            count += std::abs(qAlpha(one.pixel(x, y)) - qAlpha(other.pixel(x, y))) > 2 ? 1 : 0;
        if (count > 0)
            text += QStringLiteral("%1 pixels in column %2, ").arg(count).arg(x);
    }
    return text;
}

TimeView secondsPerColumn(int columns, int first = 0)
{
    return {1s, first, columns, {}};
}

} // namespace

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
        QVERIFY(wide.to() - wide.from() <= TimeWindow::LongestSpan + wide.step * 1000);
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

    void fewSamplesAreJoinedByLines()
    {
        History history;
        history.append(0s, 0);
        history.append(4s + 999ms, 5);
        const QStringList picture = painted(traceOf(history), secondsPerColumn(7), {0, 5, 1, 0}, 5);
        // Rises from the lower left to the upper right and ends there.
        QCOMPARE(picture.size(), 5);
        for (int i = 0; i < 5; ++i)
            QVERIFY2(picture[4 - i][i] != u'.', qPrintable(picture.join(u'\n')));
        QCOMPARE(picture[0][0], u'.');
        for (int y = 0; y < 5; ++y)
            QVERIFY2(picture[y].endsWith(u".."), qPrintable(picture.join(u'\n')));
    }

    void noLineCrossesAGap()
    {
        History history;
        history.append(500ms, 2);
        history.append(1500ms, 2);
        history.appendGap(2s);
        history.append(5500ms, 2);
        const QStringList picture = painted(traceOf(history), secondsPerColumn(8), {0, 5, 1, 0}, 5);
        QCOMPARE(picture[3].left(2).count(u'.'), 0);
        QCOMPARE(picture[3].mid(2, 3), QStringLiteral("..."));
        QVERIFY(picture[3][5] != u'.');
    }

    void steepStepsDoNotOvershoot()
    {
        History history;
        history.append(500ms, 10);
        history.append(2400ms, 10);
        history.append(2600ms, 90);
        history.append(6s, 90);
        const QStringList picture = painted(traceOf(history), secondsPerColumn(6), {0, 100, 20, 0}, 100);
        for (int y = 0; y < 100; ++y) {
            if (y < 9 || y > 91)
                QCOMPARE(picture[y], QStringLiteral("......"));
        }
    }

    void manySamplesBecomeSpans()
    {
        History history;
        for (int i = 0; i < 4000; ++i)
            history.append(1ms * i, i % 2 == 0 ? 10 : 90);
        const QStringList picture = painted(traceOf(history), secondsPerColumn(4), {0, 100, 20, 0}, 100);
        QCOMPARE(picture[50], QStringLiteral("####"));
        QCOMPARE(picture[11], QStringLiteral("####"));
        QCOMPARE(picture[5], QStringLiteral("...."));
        QCOMPARE(picture[95], QStringLiteral("...."));
    }

    void farValuesAreCutOff()
    {
        History history;
        for (int i = 0; i < 100; ++i)
            history.append(10ms * i, i % 2 == 0 ? 2'000'000'000 : -2'000'000'000);
        QCOMPARE(painted(traceOf(history), secondsPerColumn(1), {0, 1, 1, 0}, 2),
            QStringList({QStringLiteral("#"), QStringLiteral("#")}));
        QCOMPARE(painted(traceOf(history), {10ms, 0, 100, {}}, {0, 1, 1, 0}, 2).size(), 2);
        QCOMPARE(painted(traceOf(history), secondsPerColumn(1), {3e9, 4e9, 1, 0}, 2),
            QStringList({QStringLiteral("."), QStringLiteral(".")}));
    }

    void scrolledPictureIsTheWholeOne_data()
    {
        QTest::addColumn<int>("interval"); ///< microseconds between samples; a column is 1 ms
        QTest::newRow("spans") << 20;
        QTest::newRow("lines") << 700;
        QTest::newRow("long lines with dots") << 15'000;
    }

    void scrolledPictureIsTheWholeOne()
    {
        QFETCH(int, interval);
        QRandomGenerator random(3);
        std::array<History, 3> histories;
        std::vector<TraceData> traces;
        for (History &history : histories)
            traces.push_back(traceOf(history));
        traces[1].color = QColor(0, 0, 255, 100);
        const AxisRange range{-1000, 1000, 500, 0};
        TraceImage scrolled;
        LineTime now = 1s;
        for (; now < 1250ms; now += std::chrono::microseconds(interval / 3))
            histories[static_cast<std::size_t>(random.bounded(3))].append(now, random.bounded(-900, 900));
        for (int frame = 0; frame < 60; ++frame) {
            const LineTime end = now + std::chrono::microseconds(random.bounded(16'000));
            for (; now < end; now += std::chrono::microseconds(random.bounded(1, 2 * interval))) {
                History &history = histories[static_cast<std::size_t>(random.bounded(3))];
                if (random.bounded(50) == 0)
                    history.appendGap(now);
                history.append(now, random.bounded(-900, 900));
            }
            if (frame == 40)
                traces[0].visible = false;
            std::vector<TraceImage::Item> items;
            for (const TraceData &trace : traces)
                items.push_back({&trace, &range, 1.5F, false});
            const TimeView view{1ms, now / 1ms - 199, 200, {}};
            const QImage &image = scrolled.paint(items, view, 100);
            TraceImage fresh;
            const QImage &whole = fresh.paint(items, view, 100);
            QCOMPARE(QStringLiteral("frame %1: ").arg(frame) + difference(image, whole),
                QStringLiteral("frame %1: ").arg(frame));
        }
    }

    void hiddenTracesAreNotPainted()
    {
        History history;
        history.append(500ms, 2);
        history.append(9500ms, 2);
        TraceData trace = traceOf(history);
        trace.visible = false;
        QVERIFY(!painted(trace, secondsPerColumn(8), {0, 5, 1, 0}, 5).join(QString()).contains(u'#'));
        trace.visible = true;
        trace.history = nullptr;
        QVERIFY(!painted(trace, secondsPerColumn(8), {0, 5, 1, 0}, 5).join(QString()).contains(u'#'));
    }

    void csvHasAColumnPerTrace()
    {
        CsvColumn position{QStringLiteral("left, \"upper\" · Present Position (°)"), 0.5, 0, 1, {}};
        CsvColumn current{QStringLiteral("#2 · Present Current (mA)"), 1, 0, 0, {}};
        for (int i = 1; i <= 3; ++i)
            position.samples.push_back({10s + 10ms * i, 100 * i});
        current.samples = {{10s + 20ms, -3}, {10s + 25ms, -4}};
        QBuffer buffer;
        buffer.open(QIODevice::WriteOnly);
        QVERIFY(writeCsv(buffer, std::vector{position, current}, false));
        QCOMPARE(QString::fromUtf8(buffer.data()),
            QStringLiteral("Time (s),\"left, \"\"upper\"\" · Present Position (°)\",#2 · Present Current (mA)\n"
                           "0.000000,50.0,\n"
                           "0.010000,100.0,-3\n"
                           "0.015000,,-4\n"
                           "0.020000,150.0,\n"));
    }

    void unwritableFileIsSaid()
    {
        const auto result = saveCsv(QStringLiteral("/nowhere/at all.csv"), {}, false);
        QVERIFY(!result);
        QVERIFY(result.error().text.contains(QStringLiteral("at all.csv")));
    }

    void stateSurvivesTheTrip()
    {
        PlotState state;
        state.spanSeconds = 60;
        state.autoscale = false;
        state.panels = {{{QStringLiteral("/dev/ttyUSB0"), 1020, 3, QStringLiteral("Present Position"), 2, false}}, {}};
        const auto back = PlotState::fromBytes(state.toBytes());
        QVERIFY(back);
        QCOMPARE(back->spanSeconds, 60);
        QCOMPARE(back->autoscale, false);
        QVERIFY(back->panels == state.panels);
        QVERIFY(!PlotState::fromBytes({}));
        QVERIFY(!PlotState::fromBytes("{\"panels\":"));
        QVERIFY(PlotState::fromBytes("{\"panels\":[[5,{\"id\":\"x\"}],7]}"));
    }
};

DYNASCOPE_UI_TEST(TestPlot)
#include "tst_plot.moc"
