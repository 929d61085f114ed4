// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "ui/common/watchmime.h"
#include "ui/plot/tracedelegate.h"

#include <QAbstractItemModelTester>
#include <QContextMenuEvent>
#include <QDropEvent>
#include <QMenu>
#include <QSignalSpy>

#include <set>
#include <QToolButton>
#include <QWheelEvent>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

class PaintCount final : public QObject
{
public:
    explicit PaintCount(QWidget &widget) { widget.installEventFilter(this); }

    int count = 0;

    bool eventFilter(QObject *, QEvent *event) override
    {
        count += event->type() == QEvent::Paint;
        return false;
    }
};

void wheel(QWidget &widget, int steps, Qt::KeyboardModifiers modifiers = {})
{
    const QPointF at = widget.rect().center();
    QWheelEvent event(
        at, widget.mapToGlobal(at), {}, {0, 120 * steps}, Qt::NoButton, modifiers, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &event);
}

} // namespace

class TestPlotArea : public QObject
{
    Q_OBJECT

private slots:
    void tracesAreWatched()
    {
        PlotBench bench;
        const QAbstractItemModelTester tester(&bench.model());
        QSignalSpy changes(&bench.area, &PlotArea::tracesChanged);
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.area.addTrace(position);
        QCOMPARE(changes.count(), 1);
        QVERIFY(bench.area.shows(position));
        QVERIFY(bench.monitor.isWatched(position));
        QCOMPARE(bench.model().rowCount(), 1);
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("XM430-W350 #1 · Present Position"));
        bench.area.removeTrace(position);
        QVERIFY(!bench.area.shows(position));
        QVERIFY(!bench.monitor.isWatched(position));
        QVERIFY(bench.area.traces().empty());
        QCOMPARE(changes.count(), 2);
        bench.area.addTrace({77, 0}); // nobody
        bench.area.addTrace({bench.first.key(), 9999});
        QCOMPARE(bench.model().rowCount(), 0);
    }

    void aTraceInTwoPanelsIsWatchedUntilBothAreGone()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        PlotPanel *lower = bench.area.addPanel();
        emit lower->watchesDropped({position});
        QCOMPARE(lower->model().rowCount(), 1);
        QCOMPARE(bench.area.traces().size(), std::size_t(1));
        bench.area.closePanel(lower);
        QVERIFY(bench.monitor.isWatched(position));
        bench.area.closePanel(bench.area.panels().front()); // the last one stays
        QCOMPARE(bench.area.panels().size(), std::size_t(1));
        QVERIFY(bench.area.shows(position));
    }

    void valuesArePhysical()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        QCOMPARE(bench.model().index(0).data(TraceModel::ValueRole).toString(), QString());
        bench.sample(position, 1s, 2048);
        bench.model().refreshValues();
        QCOMPARE(bench.model().index(0).data(TraceModel::ValueRole).toString(), QStringLiteral("180.00"));
        QCOMPARE(bench.model().index(0).data(TraceModel::UnitRole).toString(), QStringLiteral("°"));
        QSignalSpy changes(&bench.model(), &TraceModel::dataChanged);
        bench.model().refreshValues(); // nothing new: nothing to repaint
        QCOMPARE(changes.count(), 0);
    }

    void axesFitWhatIsSeen()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        bench.sample(position, 2s, 3072);
        QTRY_COMPARE(bench.chart().view().to() > 2s, true);
        bench.chart().grab();
        const AxisRange range = bench.chart().scales().range(QStringLiteral("°"));
        QVERIFY(range.minimum <= 90 && range.minimum > 45);
        QVERIFY(range.maximum >= 270 && range.maximum < 315);
        wheel(bench.chart(), 3, Qt::ControlModifier); // by hand
        QVERIFY(!bench.action(QStringLiteral("Autoscale"))->isChecked());
        const double zoomed = bench.chart().scales().range(QStringLiteral("°")).span();
        QVERIFY(zoomed < range.span());
        bench.sample(position, 3s, 4000);
        bench.chart().grab();
        QCOMPARE(bench.chart().scales().range(QStringLiteral("°")).span(), zoomed);
        bench.action(QStringLiteral("Autoscale"))->trigger();
        // The axis follows once the frame with the newest sample is in view.
        QTRY_VERIFY((bench.chart().grab(), bench.chart().scales().range(QStringLiteral("°")).maximum > 351));
    }

    void labelsFollowTheDevice()
    {
        PlotBench bench;
        bench.area.addTrace(bench.watch(bench.first, "Present Position"));
        bench.line.moveDevice(bench.first, {9, 57600, 1020, 45, false, {}});
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("XM430-W350 #9 · Present Position"));
        bench.first.setNickname(QStringLiteral("elbow"));
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("elbow · Present Position"));
    }

    void tracesOfAGoneDeviceStayDimmed()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        const Watch other = bench.watch(bench.second, "Present Position");
        bench.area.addTrace(position);
        bench.area.addTrace(other);
        bench.sample(position, 1s, 2048);
        bench.sample(other, 1s, 2048);
        bench.line.forget(bench.first.key());
        QCOMPARE(bench.model().rowCount(), 2);
        QVERIFY(bench.model().index(0).data(TraceModel::GoneRole).toBool());
        QVERIFY(!bench.model().index(1).data(TraceModel::GoneRole).toBool());
        bench.chart().grab(); // whatever its history was, nothing is drawn from it
        bench.area.removeTrace(position);
        QCOMPARE(bench.model().rowCount(), 1);
    }

    void tracesOfADeviceThatIsBackGoOn()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        const Watch other = bench.watch(bench.second, "Present Position");
        bench.area.addTrace(other);
        bench.line.forget(bench.first.key());
        QVERIFY(!bench.monitor.isWatched(position));
        Device &stranger = bench.line.heard({3, 1'000'000, 1020, 45, false, {}});
        QVERIFY(stranger.key() != position.device);
        QVERIFY(bench.model().index(0).data(TraceModel::GoneRole).toBool());

        Device &back = bench.line.heard({1, 1'000'000, 1020, 45, false, {}});
        QCOMPARE(back.key(), position.device);
        QCOMPARE(bench.model().rowCount(), 2); // the same trace, not another one
        QVERIFY(!bench.model().index(0).data(TraceModel::GoneRole).toBool());
        QVERIFY(bench.monitor.isWatched(position));
        bench.sample(position, 2s, 2048);
        QTRY_COMPARE(bench.model().index(0).data(TraceModel::ValueRole).toString(), QStringLiteral("180.00"));
        back.setNickname(QStringLiteral("elbow"));
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("elbow · Present Position"));
    }

    void pauseFreezes()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        for (int i = 0; i < 100; ++i)
            bench.sample(position, 1s + 10ms * i, 20 * i);
        QTRY_VERIFY(bench.chart().view().to() > 1900ms);
        bench.action(QStringLiteral("Pause"))->trigger();
        const QImage before = bench.chart().grab().toImage();
        const TimeView view = bench.chart().view();
        bench.sample(position, 20s, 4000);
        bench.area.hide();
        bench.area.show(); // looks at everything once more
        QVERIFY(bench.chart().view() == view);
        QVERIFY(bench.chart().grab().toImage() == before);
        bench.action(QStringLiteral("Live"))->trigger();
        QVERIFY(bench.chart().view().to() > 20s);
        QVERIFY(bench.chart().grab().toImage() != before);
    }

    void pausedViewIsDraggedAndZoomed()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 100s, 1);
        bench.area.setLive(false);
        const TimeView before = bench.chart().view();
        const QPoint centre = bench.chart().plotArea().center().toPoint();
        QTest::mousePress(&bench.chart(), Qt::LeftButton, {}, centre);
        QTest::mouseMove(&bench.chart(), centre + QPoint(100, 0));
        QTest::mouseRelease(&bench.chart(), Qt::LeftButton, {}, centre + QPoint(100, 0));
        QCOMPARE(bench.chart().view().firstColumn, before.firstColumn - 100);
        wheel(bench.chart(), 2);
        QVERIFY(bench.chart().view().step < before.step);
        QTest::mouseDClick(&bench.chart(), Qt::LeftButton, {}, centre);
        QVERIFY(bench.area.timeWindow().isLive());
    }

    void everyUnitHasAnAxis()
    {
        PlotBench bench;
        bench.area.resize(900, 600);
        const char *const names[]{"Present Position", "Present Current", "Present Velocity", "Present Temperature"};
        QList<qreal> widths;
        for (const char *name : names) {
            bench.area.addTrace(bench.watch(bench.first, name));
            widths << bench.chart().plotArea().width();
        }
        QCOMPARE(bench.chart().labelColumns().right, 3);
        QVERIFY(widths[1] < widths[0] && widths[2] < widths[1] && widths[3] < widths[2]);
        const QImage picture = bench.chart().grab().toImage();
        const int right = int(bench.chart().plotArea().right()) + 1;
        const int column = (bench.chart().width() - right) / 3;
        for (int i = 0; i < 3; ++i) { // each column has ink below its heading
            std::set<QRgb> inks;
            for (int x = right + i * column + 4; x < right + (i + 1) * column; ++x) {
                for (int y = 30; y < picture.height() - 30; ++y)
                    inks.insert(picture.pixel(x, y));
            }
            QVERIFY(inks.size() > 1);
        }
    }

    void negativeValuesHaveTheMinusOfTheTable()
    {
        PlotBench bench;
        const Watch velocity = bench.watch(bench.first, "Present Velocity");
        bench.area.addTrace(velocity);
        bench.sample(velocity, 1s, -100);
        bench.model().refreshValues();
        const QString text = bench.model().index(0).data(TraceModel::ValueRole).toString();
        QVERIFY2(text.startsWith(QChar(0x2212)), qPrintable(text));
    }

    void aSpanTypedTooLongIsTheLongest_data()
    {
        QTest::addColumn<QString>("typed");
        QTest::addColumn<int>("seconds");
        QTest::newRow("too long") << QStringLiteral("700") << 600;
        QTest::newRow("much too long") << QStringLiteral("123456") << 600;
        QTest::newRow("too short") << QStringLiteral("0") << 1;
        QTest::newRow("as it is") << QStringLiteral("70") << 70;
    }
    void aSpanTypedTooLongIsTheLongest()
    {
        QFETCH(QString, typed);
        PlotBench bench;
        auto *span = bench.area.findChild<SpanBox *>();
        span->selectAll();
        QTest::keyClicks(span, typed);
        QTest::keyClick(span, Qt::Key_Return);
        QTEST(span->value(), "seconds");
    }

    void spanGoesFromOneSecondToTenMinutes()
    {
        PlotBench bench;
        auto *span = bench.area.findChild<SpanBox *>();
        span->setValue(5000);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(600s));
        span->setValue(0);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(1s));
        wheel(bench.chart(), -1);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(2s));
        span->setValue(7);
        wheel(bench.chart(), -1);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(10s));
        wheel(bench.chart(), 2);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(2s));
        wheel(bench.chart(), 9);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(1s));
    }

    void aTraceIsHiddenByEyeAndKey()
    {
        PlotBench bench;
        bench.area.addTrace(bench.watch(bench.first, "Present Position"));
        bench.area.addTrace(bench.watch(bench.first, "Present Current"));
        TraceList &list = bench.list();
        QTRY_VERIFY(list.isVisible());
        const QRect row = list.visualRect(bench.model().index(1));
        QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, TraceDelegate::eyeRect(row).center());
        QVERIFY(!bench.model().isVisible(1));
        QVERIFY(!bench.chart().traces()[1].visible);
        QVERIFY(bench.monitor.isWatched(bench.model().watch(1))); // hidden, still recorded
        list.setCurrentIndex(bench.model().index(1));
        QTest::keyClick(&list, Qt::Key_Space);
        QVERIFY(bench.model().isVisible(1));
        QTest::keyClick(&list, Qt::Key_Delete);
        QCOMPARE(bench.model().rowCount(), 1);
        const QRect first = list.visualRect(bench.model().index(0));
        QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, TraceDelegate::removeRect(first).center());
        QCOMPARE(bench.model().rowCount(), 0);
        QVERIFY(bench.monitor.watches().empty());
    }

    void theMenuHidesAllOthers()
    {
        PlotBench bench;
        bench.area.addTrace(bench.watch(bench.first, "Present Position"));
        bench.area.addTrace(bench.watch(bench.first, "Present Current"));
        TraceList &list = bench.list();
        list.setCurrentIndex(bench.model().index(1));
        QContextMenuEvent event(QContextMenuEvent::Keyboard, QPoint(), QPoint());
        QCoreApplication::sendEvent(list.viewport(), &event);
        auto *menu = list.findChild<QMenu *>();
        QVERIFY(menu);
        menu->actions()[1]->trigger();
        menu->close();
        QVERIFY(!bench.model().isVisible(0));
        QVERIFY(bench.model().isVisible(1));
    }

    void fieldsAreDropped()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        const Watch current = bench.watch(bench.first, "Present Current");
        const auto mime = watchesToMime({position, current});
        PlotPanel *panel = bench.area.panels().front();
        QDragEnterEvent enter({10, 10}, Qt::CopyAction, mime.get(), Qt::LeftButton, {});
        QCoreApplication::sendEvent(panel, &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop({10, 10}, Qt::CopyAction, mime.get(), Qt::LeftButton, {});
        QCoreApplication::sendEvent(panel, &drop);
        QVERIFY(bench.area.shows(position) && bench.area.shows(current));
        QMimeData text;
        text.setText(QStringLiteral("no field"));
        QDragEnterEvent other({10, 10}, Qt::CopyAction, &text, Qt::LeftButton, {});
        other.ignore();
        QCoreApplication::sendEvent(panel, &other);
        QVERIFY(!other.isAccepted());
    }

    void clearForgetsSamplesAndKeepsTraces()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 2048);
        bench.action(QStringLiteral("Clear"))->trigger();
        QCOMPARE(bench.model().rowCount(), 1);
        QVERIFY(bench.monitor.history(position)->isEmpty());
        bench.sample(position, 2s, 1024);
        QTRY_VERIFY(bench.chart().view().to() > 2s);
    }

    void newValuesAloneDontRepaintAPausedPlot()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        bench.action(QStringLiteral("Pause"))->trigger();
        QCoreApplication::processEvents();
        PaintCount paints(bench.chart());
        bench.sample(position, 2s, 3072);
        QTRY_COMPARE(bench.model().index(0).data(TraceModel::ValueRole).toString(), QStringLiteral("270.00"));
        QCoreApplication::processEvents();
        QCOMPARE(paints.count, 0);
        bench.model().setVisible(0, false);
        QCoreApplication::processEvents();
        QCOMPARE(paints.count, 1);
    }

    void everythingHasATip()
    {
        PlotBench bench;
        for (const QAction *action : bench.area.findChild<PlotBar *>()->actions()) {
            if (!action->isSeparator() && !action->text().isEmpty())
                QVERIFY2(action->toolTip().size() > action->text().size(), qPrintable(action->text()));
        }
        QVERIFY(!bench.action(QStringLiteral("Clear"))->isEnabled()); // nothing to clear
    }
};

DYNASCOPE_UI_TEST(TestPlotArea)
#include "tst_plotarea.moc"
