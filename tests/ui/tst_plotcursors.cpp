// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "ui/plot/measuremodel.h"
#include "ui/plot/measuretable.h"

#include <QAbstractItemModelTester>
#include <QToolButton>
#include <QWheelEvent>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

void wheelAt(QWidget &widget, QPointF at, int steps)
{
    QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, 120 * steps}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &event);
}

void drag(QWidget &widget, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {})
{
    QTest::mousePress(&widget, Qt::LeftButton, modifiers, from);
    QTest::mouseMove(&widget, from + (to - from) / 2);
    QTest::mouseMove(&widget, to);
    QTest::mouseRelease(&widget, Qt::LeftButton, modifiers, to);
}

/// Two traces of two units, ten seconds of a ramp, paused.
struct RampBench : PlotBench {
    Watch position = watch(first, "Present Position");
    Watch current = watch(first, "Present Current");

    RampBench()
    {
        area.resize(900, 500);
        for (const Watch &each : {position, current})
            area.addTrace(each);
        for (int i = 0; i <= 1000; ++i) {
            sample(position, 10ms * i, 2 * i);
            sample(current, 10ms * i, 100);
        }
        area.setLive(false);
        chart().grab();
    }
    MeasureTable &table(std::size_t panel = 0) const { return *area.panels()[panel]->findChild<MeasureTable *>(); }
    QString figure(int row, int column) const { return table().model()->index(row, column).data().toString(); }
    QPoint at(double part, double down = 0.5) const
    {
        const QRectF plot = chart().plotArea();
        return QPointF(plot.left() + part * plot.width(), plot.top() + down * plot.height()).toPoint();
    }
};

} // namespace

/// Cursors, and how a plot is zoomed and moved.
class TestPlotCursors : public QObject
{
    Q_OBJECT

private slots:
    void aDoubleClickMovesNoCursor()
    {
        RampBench bench;
        bench.area.setCursorsOn(true);
        const PlotCursors before = bench.area.cursors();
        QTest::mouseDClick(&bench.chart(), Qt::LeftButton, {}, bench.at(0.2));
        QVERIFY(bench.area.timeWindow().isLive());
        QVERIFY(bench.area.cursors() == before);
    }

    /// Two panels in a column as narrow as that of the window: charts, not lists and figures.
    void chartsKeepTheirHeight()
    {
        PlotBench bench;
        bench.area.addPanel();
        for (std::size_t panel = 0; panel < 2; ++panel) {
            emit bench.area.panels()[panel]->activated();
            for (const char *field : {"Present Position", "Goal Position", "Present Velocity", "Present PWM", "Present Current"})
                bench.area.addTrace(bench.watch(panel == 0 ? bench.first : bench.second, field));
        }
        for (const int height : {640, 900}) {
            bench.area.resize(350, height);
            for (const bool on : {false, true}) {
                bench.area.setCursorsOn(on);
                QTRY_COMPARE(bench.area.panels()[0]->findChild<MeasureTable *>()->isVisible(), on);
                QTest::qWait(0); // the layouts' turn
                for (const PlotPanel *panel : bench.area.panels()) {
                    const int least = std::max(96, std::min(panel->height() * 2 / 5, 300));
                    QVERIFY2(panel->chart().height() >= least,
                        qPrintable(QStringLiteral("%1 of %2").arg(panel->chart().height()).arg(panel->height())));
                    QVERIFY(panel->findChild<TraceList *>()->height() >= 60);
                }
            }
        }
    }

    void cursorsMeasureWhatIsBetween()
    {
        RampBench bench;
        const QAbstractItemModelTester tester(bench.table().model());
        QVERIFY(!bench.table().isVisible());
        bench.action(QStringLiteral("Cursors"))->trigger();
        QVERIFY(bench.table().isVisible());
        emit bench.chart().cursorMoved(0, -6s); // from the newest, which is at 10 s
        emit bench.chart().cursorMoved(1, -2s);
        const QString mean = QStringLiteral("105.469"); // of 4 s and 8 s, 2 pulses each 10 ms
        QTRY_COMPARE(bench.figure(0, MeasureModel::Mean), mean);
        QCOMPARE(bench.figure(0, MeasureModel::AtA), QStringLiteral("70.31"));
        QCOMPARE(bench.figure(0, MeasureModel::AtB), QStringLiteral("140.63"));
        QCOMPARE(bench.figure(0, MeasureModel::Change), QStringLiteral("70.31"));
        QCOMPARE(bench.figure(0, MeasureModel::Minimum), QStringLiteral("70.31"));
        QCOMPARE(bench.figure(0, MeasureModel::Maximum), QStringLiteral("140.63"));
        QCOMPARE(bench.figure(0, MeasureModel::Frequency), QStringLiteral("–"));
        QCOMPARE(bench.figure(1, MeasureModel::Change).remove(u'.').remove(u'0'), QString());
        QTRY_COMPARE(bench.table().model()->headerData(0, Qt::Horizontal, Qt::DisplayRole).toString(),
            QStringLiteral("Δt 4.0000 s · 0.250 Hz"));
        bench.model().setVisible(0, false);
        QTRY_COMPARE(bench.table().model()->rowCount(), 1);
        bench.area.removeTrace(bench.position);
        bench.area.removeTrace(bench.current);
        QVERIFY(!bench.table().isVisible());
    }

    void cursorsAreDraggedAndPlacedByKeys()
    {
        RampBench bench;
        QTest::keyClick(&bench.chart(), Qt::Key_C);
        QVERIFY(bench.area.cursors().isOn);
        const TimeView view = bench.chart().view();
        drag(bench.chart(), bench.at(1 / 3.0), bench.at(0.5));
        QVERIFY(std::abs((bench.area.cursors().at[0] - LineTime(-5s)).count()) < 2 * view.step.count());
        QVERIFY(bench.chart().view() == view); // the plot stays where it was
        QTest::mouseMove(&bench.chart(), bench.at(0.9));
        QTest::keyClick(&bench.chart(), Qt::Key_B);
        const LineTime b = bench.area.cursors().at[1];
        QVERIFY(std::abs((b - LineTime(-1s)).count()) < 2 * view.step.count());
        QTest::keyClick(&bench.chart(), Qt::Key_Left, Qt::ShiftModifier);
        QCOMPARE(bench.area.cursors().at[1], b - view.step);
        QTest::mouseClick(&bench.chart(), Qt::LeftButton, {}, bench.at(0.7)); // the last one goes there
        QVERIFY(std::abs((bench.area.cursors().at[1] - LineTime(-3s)).count()) < 2 * view.step.count());
        QTest::keyClick(&bench.chart(), Qt::Key_C);
        QVERIFY(!bench.area.cursors().isOn);
        QVERIFY(!bench.action(QStringLiteral("Cursors"))->isChecked());
        QTest::keyClick(&bench.chart(), Qt::Key_A); // and brings them back
        QVERIFY(bench.area.cursors().isOn);
    }

    void aBoxZoomsTimesAndValues()
    {
        RampBench bench;
        bench.area.setLive(true);
        bench.chart().grab();
        const AxisRange before = bench.chart().scales().range(QStringLiteral("°"));
        drag(bench.chart(), bench.at(0.25, 0.5), bench.at(0.75, 0.75), Qt::ShiftModifier);
        QVERIFY(!bench.area.timeWindow().isLive());
        const TimeView view = bench.chart().view();
        QVERIFY(std::abs(std::chrono::duration<double>(view.to() - view.from()).count() - 5) < 0.05);
        QVERIFY(std::abs(std::chrono::duration<double>(view.from()).count() - 2.5) < 0.05);
        const AxisRange after = bench.chart().scales().range(QStringLiteral("°"));
        QVERIFY(std::abs(after.span() - before.span() / 4) < before.span() / 50);
        QVERIFY(std::abs(after.maximum - (before.minimum + before.span() / 2)) < before.span() / 50);
        QVERIFY(!bench.action(QStringLiteral("Autoscale"))->isChecked());
        drag(bench.chart(), bench.at(0.25, 0.5), bench.at(0.251, 0.501), Qt::ShiftModifier); // a slip of the hand
        QVERIFY(bench.chart().view() == view);
    }

    void backToLiveIsInSightWhilePaused()
    {
        RampBench bench;
        QToolButton *live = nullptr;
        for (QToolButton *button : bench.area.panels().front()->findChildren<QToolButton *>()) {
            if (button->text() == QStringLiteral("Back to live"))
                live = button;
        }
        QVERIFY(live && live->isVisible());
        live->click();
        QVERIFY(bench.area.timeWindow().isLive());
        QVERIFY(!live->isVisible());
    }

    void theWheelOverAnAxisZoomsItAlone()
    {
        RampBench bench;
        const AxisRange degrees = bench.chart().scales().range(QStringLiteral("°"));
        const AxisRange current = bench.chart().scales().range(QStringLiteral("mA"));
        QVERIFY(current.span() > 0);
        const TimeView view = bench.chart().view();
        wheelAt(bench.chart(), QPointF(10, bench.at(0).y()), 2);
        QVERIFY(bench.chart().scales().range(QStringLiteral("°")).span() < degrees.span());
        QCOMPARE(bench.chart().scales().range(QStringLiteral("mA")).span(), current.span());
        QVERIFY(bench.chart().view() == view);
        QVERIFY(!bench.action(QStringLiteral("Autoscale"))->isChecked());
        wheelAt(bench.chart(), QPointF(bench.chart().width() - 10, bench.at(0).y()), -2);
        QVERIFY(bench.chart().scales().range(QStringLiteral("mA")).span() > current.span());
        QTest::mouseDClick(&bench.chart(), Qt::LeftButton, {}, QPoint(10, bench.at(0).y())); // follows again
        bench.chart().grab();
        QCOMPARE(bench.chart().scales().range(QStringLiteral("°")).span(), degrees.span());
        QVERIFY(bench.chart().scales().range(QStringLiteral("mA")).span() > current.span());
        bench.action(QStringLiteral("Autoscale"))->trigger();
        bench.chart().grab();
        QCOMPARE(bench.chart().scales().range(QStringLiteral("mA")).span(), current.span());
    }

    void axesAreDragged()
    {
        RampBench bench;
        const AxisRange degrees = bench.chart().scales().range(QStringLiteral("°"));
        drag(bench.chart(), QPoint(10, bench.at(0, 0.7).y()), QPoint(10, bench.at(0, 0.3).y())); // up: closer
        QVERIFY(bench.chart().scales().range(QStringLiteral("°")).span() < degrees.span() / 2);
        const TimeView view = bench.chart().view();
        const int below = int(bench.chart().plotArea().bottom()) + 8;
        drag(bench.chart(), QPoint(300, below), QPoint(400, below));
        QVERIFY(bench.chart().view().step < view.step);
    }

    void aPanelMayHaveItsOwnTime()
    {
        RampBench bench;
        PlotPanel *lower = bench.area.addPanel();
        emit lower->watchesDropped({bench.position});
        const TimeView shared = bench.chart(0).view();
        lower->setOwnTime(true);
        emit bench.chart(1).zoomed(0.5, 8s);
        QVERIFY(bench.chart(0).view().step == shared.step);
        QVERIFY(bench.chart(1).view().step < shared.step);
        bench.area.setLive(true);
        emit bench.chart(1).spanStepped(1);
        QCOMPARE(lower->ownTime().span(), LineTime(20s));
        QCOMPARE(bench.area.timeWindow().span(), LineTime(10s));
        lower->setOwnTime(false);
        QVERIFY(bench.chart(1).view().step == bench.chart(0).view().step);
    }
};

DYNASCOPE_UI_TEST(TestPlotCursors)
#include "tst_plotcursors.moc"
