// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "ui/plot/plotexport.h"

#include <QBuffer>
#include <QFileDialog>
#include <QSignalSpy>
#include <QTemporaryDir>

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
        QSignalSpy messages(&bench.area, &PlotArea::message);
        const QString path = save(bench, QStringLiteral("Save plots as CSV…"), QStringLiteral("plot.csv"));
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(QString::fromUtf8(file.readAll()),
            QStringLiteral("Time (s),XM430-W350 #1 · Present Position (°)\n0.000000,90.00\n0.500000,180.00\n"));
        QCOMPARE(messages.count(), 1);
    }

    void plotsAreSavedAsAPicture()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, 1s, 1024);
        QSignalSpy messages(&bench.area, &PlotArea::message);
        const QString path = save(bench, QStringLiteral("Save plots as a picture…"), QStringLiteral("plot.png"));
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
