// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/uitest.h"
#include "ui/common/watchmime.h"
#include "ui/plot/plotarea.h"
#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotexport.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracedelegate.h"
#include "ui/plot/tracelist.h"
#include "ui/plot/tracemodel.h"

#include <QAbstractItemModelTester>
#include <QBuffer>
#include <QContextMenuEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QMenu>
#include <QSignalSpy>
#include <QToolButton>
#include <QWheelEvent>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// No line opens: what the devices say, the test says in their place.
class NoLines : public LineFactory
{
public:
    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &name, int) override
    {
        return failure(ErrorKind::PortNotFound, name);
    }
};

/// A session with two servos, and a plot area.
struct Bench {
    NoLines factory;
    Catalog catalog = Catalog::builtIn().value();
    Session session{factory, catalog};
    Monitor monitor{session};
    LineSession &line = session.open(QStringLiteral("test"), 1'000'000);
    Device &first = line.heard({1, 1'000'000, 1020, 45, false, {}});
    Device &second = line.heard({2, 1'000'000, 1060, 45, false, {}});
    PlotArea area{session, monitor};

    Bench()
    {
        area.resize(900, 400);
        area.show();
    }

    Watch watch(const Device &device, const char *field) const
    {
        return {device.key(), device.table().indexOf(QString::fromLatin1(field))};
    }

    /// One poll cycle brings this.
    void sample(const Watch &watch, LineTime at, std::int32_t raw)
    {
        const Device *device = session.device(watch.device);
        const Field &field = device->table().fields()[static_cast<std::size_t>(watch.field)];
        Batch batch;
        PollValue value;
        value.device = watch.device;
        value.address = field.address;
        value.length = field.size;
        value.data = bytesFromRaw(field, raw);
        value.at = at;
        batch.values.push_back(value);
        emit line.batchTaken(batch);
    }

    TraceModel &model(std::size_t panel = 0) const { return area.panels()[panel]->model(); }
    PlotChart &chart(std::size_t panel = 0) const { return area.panels()[panel]->chart(); }
    TraceList &list(std::size_t panel = 0) const { return *area.panels()[panel]->findChild<TraceList *>(); }
    QAction *action(const QString &text) const
    {
        for (QAction *action : area.findChild<PlotBar *>()->actions()) {
            if (action->text() == text)
                return action;
        }
        return nullptr;
    }
};

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
        Bench bench;
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
        Bench bench;
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
        Bench bench;
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
        Bench bench;
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
        Bench bench;
        bench.area.addTrace(bench.watch(bench.first, "Present Position"));
        bench.line.moveDevice(bench.first, {9, 57600, 1020, 45, false, {}});
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("XM430-W350 #9 · Present Position"));
        bench.first.setNickname(QStringLiteral("elbow"));
        QCOMPARE(bench.model().index(0).data().toString(), QStringLiteral("elbow · Present Position"));
    }

    void tracesOfAGoneDeviceStayDimmed()
    {
        Bench bench;
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

    void pauseFreezes()
    {
        Bench bench;
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
        Bench bench;
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

    void spanGoesFromOneSecondToTenMinutes()
    {
        Bench bench;
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
        Bench bench;
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
        Bench bench;
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
        Bench bench;
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
        Bench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 2048);
        bench.action(QStringLiteral("Clear"))->trigger();
        QCOMPARE(bench.model().rowCount(), 1);
        QVERIFY(bench.monitor.history(position)->isEmpty());
        bench.sample(position, 2s, 1024);
        QTRY_VERIFY(bench.chart().view().to() > 2s);
    }

    void samplesAreSavedAsCsv()
    {
        Bench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        bench.sample(position, 1500ms, 2048);
        QTRY_VERIFY(bench.chart().view().to() > 1500ms);
        QSignalSpy messages(&bench.area, &PlotArea::message);
        bench.action(QStringLiteral("Save plots as CSV…"))->trigger();
        auto *dialog = bench.area.findChild<QFileDialog *>();
        QVERIFY(dialog);
        const QTemporaryDir directory;
        const QString path = directory.filePath(QStringLiteral("plot.csv"));
        emit dialog->fileSelected(path);
        dialog->close();
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(QString::fromUtf8(file.readAll()),
            QStringLiteral("Time (s),XM430-W350 #1 · Present Position (°)\n0.000000,90.00\n0.500000,180.00\n"));
        QCOMPARE(messages.count(), 1);
    }

    void plotsAreSavedAsAPicture()
    {
        Bench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        QSignalSpy messages(&bench.area, &PlotArea::message);
        bench.action(QStringLiteral("Save plots as a picture…"))->trigger();
        auto *dialog = bench.area.findChild<QFileDialog *>();
        QVERIFY(dialog);
        const QTemporaryDir directory;
        const QString path = directory.filePath(QStringLiteral("plot.png"));
        emit dialog->fileSelected(path);
        dialog->close();
        QCOMPARE(QImage(path).size(), bench.area.panels().front()->size() * bench.area.devicePixelRatio());
        QCOMPARE(messages.value(0).value(0).toString(), QStringLiteral("Saved %1").arg(path));
    }

    void whatCantBeSavedSaysWhy()
    {
        const QTemporaryDir directory;
        const QString nowhere = directory.filePath(QStringLiteral("no/such/folder/plot"));
        const QString refused = QStringLiteral("%1 could not be written: No such file or directory").arg(nowhere);
        const Result<void> csv = saveCsv(nowhere, {}, 0s, 1s);
        QVERIFY(!csv);
        QCOMPARE(csv.error().text, refused);
        const QString here = directory.filePath(QStringLiteral("plot.png"));
        const Result<void> picture = savePicture(here, QPixmap()); // nothing to save: no fault of the file
        QVERIFY(!picture);
        QCOMPARE(picture.error().text, QStringLiteral("%1 could not be written").arg(here));
        QVERIFY(!QFile::exists(here));
        QBuffer closedToWriting;
        closedToWriting.open(QIODevice::ReadOnly);
        QTest::ignoreMessage(QtWarningMsg, "QIODevice::write (QBuffer): ReadOnly device");
        QVERIFY(!writeCsv(closedToWriting, {}, 0s, 1s)); // already its first line
    }

    void tracesComeBackWithTheirDevices()
    {
        QByteArray state;
        {
            Bench bench;
            bench.area.findChild<SpanBox *>()->setValue(60);
            bench.area.addTrace(bench.watch(bench.first, "Present Position"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Load"));
            bench.model(1).setVisible(0, false);
            state = bench.area.saveState();
        }
        Bench bench;
        bench.line.forget(bench.second.key());
        bench.area.restoreState(state);
        QCOMPARE(bench.area.timeWindow().span(), LineTime(60s));
        QCOMPARE(bench.area.panels().size(), std::size_t(2));
        QCOMPARE(bench.model(0).rowCount(), 1);
        QCOMPARE(bench.model(1).rowCount(), 0);
        QVERIFY(bench.area.saveState() == state); // what waits isn't lost
        bench.line.heard({2, 1'000'000, 1060, 45, false, {}});
        QCOMPARE(bench.model(1).rowCount(), 1);
        QVERIFY(!bench.model(1).isVisible(0));
        bench.area.restoreState("nonsense");
        QCOMPARE(bench.area.panels().size(), std::size_t(2));
    }

    void whatWaitsForAClosedPanelGoesWithIt()
    {
        QByteArray state;
        {
            Bench bench;
            bench.area.addTrace(bench.watch(bench.second, "Present Position"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Load"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Velocity"));
            state = bench.area.saveState();
        }
        Bench bench;
        bench.line.forget(bench.second.key());
        bench.area.restoreState(state);
        bench.area.closePanel(bench.area.panels().at(1));
        Device &back = bench.line.heard({2, 1'000'000, 1060, 45, false, {}});
        QVERIFY(bench.model(0).watches() == std::vector{bench.watch(back, "Present Position")});
        QVERIFY(bench.model(1).watches() == std::vector{bench.watch(back, "Present Velocity")});
    }

    void newValuesAloneDontRepaintAPausedPlot()
    {
        Bench bench;
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
        Bench bench;
        for (const QAction *action : bench.area.findChild<PlotBar *>()->actions()) {
            if (!action->isSeparator() && !action->text().isEmpty())
                QVERIFY2(action->toolTip().size() > action->text().size(), qPrintable(action->text()));
        }
        QVERIFY(!bench.action(QStringLiteral("Clear"))->isEnabled()); // nothing to clear
    }
};

DYNASCOPE_UI_TEST(TestPlotArea)
#include "tst_plotarea.moc"
