// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "tests/ui/traces.h"
#include "ui/plot/csvsave.h"
#include "ui/plot/plotdrawing.h"
#include "ui/plot/plotlayouts.h"
#include "ui/plot/plotstate.h"
#include "ui/plot/tracepaths.h"

#include <QBuffer>
#include <QFileDialog>
#include <QMenu>
#include <QPainter>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTimer>

using namespace dynascope;
using namespace std::chrono_literals;

/// What of the plots goes into files, and what is remembered from one start to the next.
class TestPlotFiles : public QObject
{
    Q_OBJECT

private slots:
    void samplesAreSavedAsCsv()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        bench.sample(position, 1500ms, 2048);
        QTRY_VERIFY(bench.chart().view().to() > 1500ms);
        QSignalSpy messages(&bench.area, &PlotArea::posted);
        const QString path = save(bench, QStringLiteral("Save plots as CSV…"), QStringLiteral("plot.csv"));
        QCOMPARE(messages.count(), 0); // the window goes on meanwhile
        QTRY_COMPARE(messages.count(), 1);
        QCOMPARE(textOf(messages.front()), QStringLiteral("Saved %1").arg(path));
        QCOMPARE(contentOf(path),
            QStringLiteral("Time (s),XM430-W350 #1 · Present Position (°)\n0.000000,90.00\n0.500000,180.00\n"));
    }

    void whatIsHiddenOrOutOfSightIsNotSaved()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        const Watch load = bench.watch(bench.second, "Present Load");
        for (const Watch &watch : {position, load}) {
            bench.area.addTrace(watch);
            for (const LineTime at : {1s, 2s, 3s})
                bench.sample(watch, at, 1024);
        }
        bench.model().setVisible(1, false);
        const auto looks = bench.model().drawn(bench.area.palette());
        CsvSave csv(bench.monitor);
        QSignalSpy written(&csv, &CsvSave::written);
        const QString path = m_directory.filePath(QStringLiteral("some.csv"));
        csv.start(path, {{position, looks[0]}, {load, looks[1]}}, 1s + 1ms, 3s);
        QTRY_COMPARE(written.count(), 1);
        QCOMPARE(contentOf(path), QStringLiteral("Time (s),XM430-W350 #1 · Present Position (°)\n0.000000,90.00\n"));
    }

    void muchIsCopiedInSlices()
    {
        PlotBench bench;
        const CsvSave::Trace trace = fill(bench, 250'000);
        CsvSave csv(bench.monitor);
        QSignalSpy written(&csv, &CsvSave::written);
        QSignalSpy failed(&csv, &CsvSave::failed);
        const QString path = m_directory.filePath(QStringLiteral("much.csv"));
        csv.start(path, {trace}, 0s, 1h);
        QTRY_COMPARE(written.count(), 1);
        QCOMPARE(contentOf(path).count(u'\n'), 250'001);
        // Between slices others have their turn. It might be a key that is STOP; here it takes the rest away.
        csv.start(path, {trace}, 0s, 1h);
        QTimer other;
        other.setSingleShot(true);
        connect(&other, &QTimer::timeout, this, [&bench] { bench.monitor.clear(); });
        other.start(0);
        QTRY_COMPARE(written.count() + failed.count(), 2);
        QCOMPARE(failed.count(), 1);
    }

    void whatIsCancelledLeavesTheFileAsItWas_data()
    {
        QTest::addColumn<bool>("cleared");
        QTest::newRow("cancelled") << false;
        QTest::newRow("its samples cleared") << true;
    }
    void whatIsCancelledLeavesTheFileAsItWas()
    {
        QFETCH(bool, cleared);
        PlotBench bench;
        const CsvSave::Trace trace = fill(bench, 10);
        const QString path = m_directory.filePath(QStringLiteral("kept.csv"));
        QFile old(path);
        QVERIFY(old.open(QIODevice::WriteOnly) && old.write("old") == 3);
        old.close();
        CsvSave csv(bench.monitor);
        QSignalSpy failed(&csv, &CsvSave::failed);
        csv.start(path, {trace}, 0s, 1h);
        if (cleared)
            bench.monitor.clear();
        else
            csv.cancel();
        QTRY_COMPARE(failed.count(), 1);
        QCOMPARE(failed.front().front().value<Error>().kind == ErrorKind::Cancelled, !cleared); // the one was wanted
        QCOMPARE(contentOf(path), QStringLiteral("old"));
        QVERIFY(!csv.isRunning());
    }

    void oneFileAtATime()
    {
        PlotBench bench;
        fill(bench, 10);
        QSignalSpy messages(&bench.area, &PlotArea::posted);
        const QString path = save(bench, QStringLiteral("Save plots as CSV…"), QStringLiteral("first.csv"));
        bench.action(QStringLiteral("Save plots as CSV…"))->trigger();
        QCOMPARE(textOf(messages.value(0)), QStringLiteral("%1 is being written").arg(path));
        QTRY_COMPARE(messages.count(), 2);
        QCOMPARE(textOf(messages.value(1)), QStringLiteral("Saved %1").arg(path));
    }

    void closingWaitsForWhatIsBeingWritten()
    {
        QString path;
        {
            PlotBench bench;
            fill(bench, 50'000);
            bench.area.addPanel();
            path = save(bench, QStringLiteral("Save plots as CSV…"), QStringLiteral("closed.csv"));
            QCoreApplication::processEvents(); // copied, and on its way
            bench.area.closePanel(bench.area.panels().front());
        }
        QVERIFY(contentOf(path).count(u'\n') > 1);
    }

    void plotsAreSavedAsAPicture()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        QSignalSpy messages(&bench.area, &PlotArea::posted);
        const QString path = save(bench, QStringLiteral("Save plots as a picture…"), QStringLiteral("plot.png"));
        QCOMPARE(QImage(path).size(), PlotDrawing(bench.area.panels()).size() * bench.area.devicePixelRatio());
        QCOMPARE(textOf(messages.value(0)), QStringLiteral("Saved %1").arg(path));
    }

    void whatCantBeSavedSaysWhy()
    {
        const QTemporaryDir directory;
        const QString nowhere = directory.filePath(QStringLiteral("no/such/folder/plot"));
        const QString refused = QStringLiteral("%1 could not be written: No such file or directory").arg(nowhere);
        const Result<void> csv = saveCsv(nowhere, {}, false);
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
        QVERIFY(!writeCsv(closedToWriting, {}, false)); // already its first line
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

    void tracesComeBackWithTheirDevices()
    {
        QByteArray state;
        {
            PlotBench bench;
            bench.area.findChild<SpanBox *>()->setValue(60);
            bench.area.addTrace(bench.watch(bench.first, "Present Position"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Load"));
            bench.model(1).setVisible(0, false);
            state = bench.area.saveState();
        }
        PlotBench bench;
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

    void looksColoursAndTriggerComeBack()
    {
        QByteArray state;
        {
            PlotBench bench;
            const Watch position = bench.watch(bench.first, "Present Position");
            bench.area.addTrace(bench.watch(bench.second, "Present Load"));
            bench.area.addTrace(position);
            bench.area.removeTrace(bench.watch(bench.second, "Present Load"));
            bench.area.addPanel()->setOwnTime(true);
            bench.chart(0).setAxisRange(QStringLiteral("°"), 10, 50);
            TriggerChoice choice;
            choice.trace = position;
            choice.level = 33;
            choice.settings.mode = TriggerSettings::Mode::Single;
            bench.area.arm(choice);
            state = bench.area.saveState();
        }
        PlotBench bench;
        bench.area.restoreState(state);
        const AxisRange range = bench.chart(0).scales().range(QStringLiteral("°"));
        QCOMPARE(range.minimum, 10.0);
        QCOMPARE(range.maximum, 50.0);
        QVERIFY(!bench.chart(0).isAutoscale());
        QVERIFY(!bench.area.panels()[0]->hasOwnTime() && bench.area.panels()[1]->hasOwnTime());
        QCOMPARE(bench.model(0).colorIndex(0), 1);
        QVERIFY(!bench.area.trigger().isOn()); // it waits for a person
        QVERIFY(bench.area.trigger().choice().trace == TraceKey(bench.watch(bench.first, "Present Position")));
        QCOMPARE(bench.area.trigger().choice().level, 33.0);
        QVERIFY(bench.area.saveState() == state);
        QVERIFY(!PlotState::fromBytes("{\"version\":99,\"panels\":[[]]}")); // of a later program
        QVERIFY(PlotState::fromBytes("{\"version\":2,\"panels\":[[]],\"looks\":[{\"axes\":[{\"min\":5,\"max\":1},7]},3],"
                                     "\"colors\":4,\"trigger\":[]}"));
    }

    void layoutsAreKeptByName()
    {
        PlotBench bench;
        bench.area.addTrace(bench.watch(bench.first, "Present Position"));
        bench.area.addPanel();
        bench.area.addTrace(bench.watch(bench.second, "Present Load"));
        QVERIFY(plotlayouts::store(QStringLiteral("  Both "), bench.area.state()));
        QVERIFY(!plotlayouts::store(QStringLiteral("  "), bench.area.state()));
        bench.area.closePanel(bench.area.panels()[1]);
        bench.area.addTrace(bench.watch(bench.first, "Present Current"));
        QCOMPARE(plotlayouts::load().size(), std::size_t(1));
        bench.area.apply(plotlayouts::load().front().state);
        QCOMPARE(bench.area.panels().size(), std::size_t(2));
        QVERIFY(bench.model(0).watches() == std::vector{bench.watch(bench.first, "Present Position")});
        QVERIFY(bench.model(1).watches() == std::vector{bench.watch(bench.second, "Present Load")});
        QVERIFY(!bench.monitor.isWatched(bench.watch(bench.first, "Present Current")));
        // Of another robot, and on an adapter that is called otherwise today.
        PlotState elsewhere = bench.area.state();
        QVERIFY(plotlayouts::fits(elsewhere, bench.session.devices()));
        for (auto &panel : elsewhere.panels)
            panel.front().line = QStringLiteral("/dev/ttyUSB7");
        QVERIFY(plotlayouts::found(elsewhere, bench.session.devices()).panels == bench.area.state().panels);
        for (auto &panel : elsewhere.panels)
            panel.front().id = 200;
        QVERIFY(!plotlayouts::fits(elsewhere, bench.session.devices()));
        QVERIFY(plotlayouts::store(QStringLiteral("Another"), elsewhere));
        QMenu menu;
        bench.area.fillLayouts(menu);
        QCOMPARE(menu.actions()[0]->text(), QStringLiteral("Both"));
        QCOMPARE(menu.actions()[1]->menu()->actions()[0]->text(), QStringLiteral("Another"));
        plotlayouts::remove(QStringLiteral("Both"));
        plotlayouts::remove(QStringLiteral("Another"));
        QVERIFY(plotlayouts::load().empty());
        QSettings().setValue(QStringLiteral("plots/layouts"), QByteArray("[{\"name\":\"x\"},5,{\"name\":\"y\",\"state\":{\"panels\":[[]]}}]"));
        QCOMPARE(plotlayouts::load().size(), std::size_t(1)); // the one that is whole
        QSettings().remove(QStringLiteral("plots/layouts"));
    }

    void plotsAreSavedAsADrawing()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        for (int i = 0; i < 20'000; ++i)
            bench.sample(position, 1ms * i, 1024 + i % 700);
        QTRY_VERIFY(bench.chart().view().to() > 19s);
        const QString path = save(bench, QStringLiteral("Save plots as SVG…"), QStringLiteral("plot.svg"));
        const QString svg = contentOf(path);
        QVERIFY(svg.contains(QStringLiteral("Present Position")));
        QVERIFY(svg.contains(bench.chart().traces().front().color.name(), Qt::CaseInsensitive)); // a path of its own
        QVERIFY2(svg.size() < 400'000, qPrintable(QString::number(svg.size()))); // columns, not samples
    }

    /// All traces by name, however few the list has room for; figures where there are cursors; nothing to click.
    void aPictureNamesAllTraces()
    {
        PlotBench bench;
        const QSize empty = PlotDrawing(bench.area.panels()).size();
        QCOMPARE(empty, bench.chart().size());
        for (const char *field : {"Present Position", "Present Velocity", "Present Current", "Present PWM", "Goal Position", "Goal PWM"})
            bench.area.addTrace(bench.watch(bench.first, field));
        bench.area.resize(350, 500);
        const QSize named = PlotDrawing(bench.area.panels()).size();
        QVERIFY(named.height() > bench.chart().height() + 6 * bench.area.fontMetrics().height());
        const QString path = save(bench, QStringLiteral("Save plots as SVG…"), QStringLiteral("names.svg"));
        const QString svg = contentOf(path);
        for (const char *field : {"Present Position", "Goal PWM"})
            QCOMPARE(svg.count(QString::fromLatin1(field)), 1);
        bench.area.setLive(false);
        QVERIFY(!contentOf(save(bench, QStringLiteral("Save plots as SVG…"), QStringLiteral("paused.svg"))).contains(QStringLiteral("live")));
        bench.area.setCursorsOn(true);
        QTRY_VERIFY(contentOf(save(bench, QStringLiteral("Save plots as SVG…"), QStringLiteral("figures.svg"))).contains(QStringLiteral("RMS")));
    }

    /// A drawing knows no clipping.
    void linesEndAtTheEdges()
    {
        History history;
        for (int i = 0; i < 400; ++i)
            history.append(10ms * i, i % 2 == 0 ? -1000 : 1000);
        std::vector traces{traceOf(history, QStringLiteral("°"))};
        PlotScales scales;
        scales.setTraces(traces);
        scales.setRange(QStringLiteral("°"), -100, 100);
        QImage image(200, 200, QImage::Format_ARGB32);
        image.fill(Qt::white);
        const QRectF area(20, 60, 160, 80);
        {
            QPainter painter(&image);
            paintPaths(painter, traces, scales, TimeView{40ms, 0, 100, {}}, area);
        }
        bool isAnything = false;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const bool isInk = image.pixel(x, y) != qRgb(255, 255, 255);
                isAnything = isAnything || isInk;
                QVERIFY2(!isInk || area.adjusted(-2, -2, 2, 2).contains(x, y), qPrintable(QStringLiteral("%1, %2").arg(x).arg(y)));
            }
        }
        QVERIFY(isAnything);
    }

    void whatWaitsForAClosedPanelGoesWithIt()
    {
        QByteArray state;
        {
            PlotBench bench;
            bench.area.addTrace(bench.watch(bench.second, "Present Position"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Load"));
            bench.area.addPanel();
            bench.area.addTrace(bench.watch(bench.second, "Present Velocity"));
            state = bench.area.saveState();
        }
        PlotBench bench;
        bench.line.forget(bench.second.key());
        bench.area.restoreState(state);
        bench.area.closePanel(bench.area.panels().at(1));
        Device &back = bench.line.heard({2, 1'000'000, 1060, 45, false, {}});
        QVERIFY(bench.model(0).watches() == std::vector{bench.watch(back, "Present Position")});
        QVERIFY(bench.model(1).watches() == std::vector{bench.watch(back, "Present Velocity")});
    }

private:
    static QString textOf(const QList<QVariant> &posted) { return posted.value(0).value<Message>().text; }
    static QString contentOf(const QString &path)
    {
        QFile file(path);
        return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
    }

    /// A trace with so many samples, a millisecond apart.
    static CsvSave::Trace fill(PlotBench &bench, int count)
    {
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        for (int i = 1; i <= count; ++i)
            bench.sample(position, 1ms * i, i % 4096);
        return {position, bench.model().drawn(bench.area.palette()).front()};
    }

    /// Picks the action and answers its dialog; where the file is.
    QString save(PlotBench &bench, const QString &action, const QString &name)
    {
        const QString path = m_directory.filePath(name);
        bench.action(action)->trigger();
        auto *dialog = bench.area.findChild<QFileDialog *>();
        if (!dialog)
            return {};
        emit dialog->fileSelected(path);
        dialog->close();
        return path;
    }

    const QTemporaryDir m_directory;
};

DYNASCOPE_UI_TEST(TestPlotFiles)
#include "tst_plotfiles.moc"
