// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/traces.h"
#include "ui/plot/axisscaler.h"
#include "ui/plot/traceimage.h"

#include <QRandomGenerator>

using namespace dynascope;

namespace {

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

} // namespace

/// How traces are painted.
class TestPlotImage : public QObject
{
    Q_OBJECT

private slots:
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
};

DYNASCOPE_UI_TEST(TestPlotImage)
#include "tst_plotimage.moc"
