// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/recordedlines.h"
#include "core/replay/replayer.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/recordings.h"
#include "tests/support/uitest.h"
#include "ui/dashboard/dashboarddialog.h"
#include "ui/plot/plotarea.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/replay/openrecording.h"
#include "ui/replay/replaytexts.h"
#include "ui/replay/replaywindow.h"
#include "ui/replay/timeline.h"
#include "ui/table/tablepanel.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QMimeData>
#include <QSignalSpy>
#include <QTreeView>
#include <QUrl>

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr quint32 Devices = 3;
constexpr int Cycles = 4000;

const Catalog &catalog()
{
    static const Catalog tables = builtInCatalog(); // read once
    return tables;
}

struct Room {
    RecordedLines lines;
    Session session{lines, catalog()};
    Monitor monitor{session};
    Replayer replayer{session, monitor};
    std::unique_ptr<ReplayWindow> window;

    explicit Room(const QString &path, bool wait = true)
    {
        QSignalSpy loaded(&replayer, &Replayer::loaded);
        if (!replayer.open(path))
            qFatal("not opened");
        window = std::make_unique<ReplayWindow>(session, monitor, replayer);
        window->show();
        if (wait && !QTest::qWaitFor([&] { return loaded.count() == 1; }))
            qFatal("not loaded");
    }
    template <typename T>
    T *find(const char *name) const
    {
        T *found = window->findChild<T *>(QLatin1String(name));
        if (!found)
            qFatal("no %s", name);
        return found;
    }
    PlotArea &plots() const { return *window->findChild<PlotArea *>(); }
    PlotChart &chart() const { return plots().panels().front()->chart(); }
    Device &device(std::size_t index) const { return *session.devices().at(index); }
};

} // namespace

class TestReplayWindow : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();
    void showsTheWholeAtOnce();
    void playsAndPauses();
    void stepsByKey();
    void seeksByClick();
    void selectsAndLocks();
    void glances();
    void followsLive();
    void standsAboveWhereItIsNarrow();
    void closesWhileItReads();
    void spellsTimes_data();
    void spellsTimes();
    void takesDroppedRecordings();

private:
    QTemporaryDir m_folder;
    QString m_path;
};

void TestReplayWindow::initTestCase()
{
    m_path = m_folder.filePath(u"arm.mcap"_s);
    writeRecording(m_path, recordingHeader(Devices), Cycles,
                   {{RecordingBegin + 1s, u"torque"_s, u"XM430-W350 #1: Torque off"_s}});
}

void TestReplayWindow::showsTheWholeAtOnce()
{
    Room room(m_path);
    QCOMPARE(room.plots().traces().size(), std::size_t(Devices)); // their positions
    QVERIFY(!room.plots().timeWindow().isLive());
    const TimeView view = room.chart().view();
    QVERIFY(view.from() <= room.replayer.clock().begin());
    QVERIFY(view.to() > room.replayer.clock().end() - 1ms);
    QVERIFY(view.to() - view.from() < LineTime(4500ms));
    QCOMPARE(view.zero, room.replayer.clock().begin());
    QCOMPARE(room.plots().events().events().size(), std::size_t(1));
    QVERIFY(room.window->windowTitle().startsWith(u"arm.mcap"));
    QCOMPARE(room.find<QLabel>("replayTime")->text(), u"0:00.000"_s);
}

void TestReplayWindow::playsAndPauses()
{
    Room room(m_path);
    auto *play = room.find<QAction>("playAction");
    auto *speed = room.find<QComboBox>("replaySpeed");
    speed->setCurrentIndex(speed->findData(10.0));
    emit speed->activated(speed->currentIndex());
    QCOMPARE(room.replayer.clock().speed(), 10.0);
    QTest::keyClick(room.window.get(), Qt::Key_Space, Qt::ControlModifier);
    QVERIFY(room.replayer.clock().isPlaying());
    QCOMPARE(play->text(), u"&Pause"_s);
    QTRY_VERIFY(room.session.now() > RecordingBegin + 200ms);
    play->trigger();
    QVERIFY(!room.replayer.clock().isPlaying());
    const QString said = room.find<QLabel>("replayTime")->text();
    QCOMPARE(said, replayTimeText(room.session.now() - room.replayer.clock().begin()));
    const Device &device = room.device(0);
    const FieldValue &position = device.value(device.table().indexOf(u"Present Position"));
    QVERIFY(position.at <= room.session.now());
    QVERIFY(position.at > room.session.now() - 2ms);
}

void TestReplayWindow::stepsByKey()
{
    Room room(m_path);
    QTest::keyClick(room.window.get(), Qt::Key_Right, Qt::ControlModifier);
    const LineTime first = room.session.now();
    QTest::keyClick(room.window.get(), Qt::Key_Right, Qt::ControlModifier);
    QCOMPARE(room.session.now() - first, LineTime(1ms));
    QTest::keyClick(room.window.get(), Qt::Key_Left, Qt::ControlModifier);
    QCOMPARE(room.session.now(), first);
    QTest::keyClick(room.window.get(), Qt::Key_Home, Qt::ControlModifier);
    QCOMPARE(room.session.now(), room.replayer.clock().begin());
}

void TestReplayWindow::seeksByClick()
{
    Room room(m_path);
    auto *timeline = room.find<Timeline>("timeline");
    QTest::mouseClick(timeline, Qt::LeftButton, {}, QPoint(timeline->width() / 2, timeline->height() / 2));
    const LineTime middle = room.session.now() - room.replayer.clock().begin();
    QVERIFY2(middle > 1900ms && middle < 2100ms, qPrintable(replayTimeText(middle)));
    timeline->setFocus();
    QTest::keyClick(timeline, Qt::Key_Right);
    QVERIFY(room.session.now() - room.replayer.clock().begin() > middle + 900ms);
    QTest::keyClick(timeline, Qt::Key_End);
    QCOMPARE(room.find<QLabel>("replayTime")->text(), u"0:03.999"_s);
    QCOMPARE(room.device(0).raw(u"Present Position").value_or(0), 2048 + static_cast<int>(1500 * std::sin(3999 * 0.003 + 1)));
}

void TestReplayWindow::selectsAndLocks()
{
    Room room(m_path);
    auto *tree = room.find<QTreeView>("deviceTree");
    QVERIFY(tree->currentIndex().isValid());
    const Device &device = room.device(0);
    const int goal = device.table().indexOf(u"Goal Position");
    QVERIFY(device.lockReason(goal).contains(u"recording"_s));
    tree->selectAll();
    QVERIFY(room.window->findChild<TablePanel *>()->isVisible());
}

void TestReplayWindow::glances()
{
    Room room(m_path);
    room.replayer.seek(RecordingBegin + 2s);
    room.find<QAction>("dashboardAction")->trigger();
    auto *dashboard = room.window->findChild<DashboardDialog *>();
    QVERIFY(dashboard);
    QVERIFY(QTest::qWaitForWindowExposed(dashboard));
    room.window->close();
    QTRY_VERIFY(!room.window->findChild<DashboardDialog *>());
}

/// Live, the right edge is where the replay stands; what is to come is not seen, nor said.
void TestReplayWindow::followsLive()
{
    Room room(m_path);
    room.replayer.seek(RecordingBegin + 2s);
    room.plots().setLive(true);
    const TimeView view = room.chart().view();
    QVERIFY(view.to() >= RecordingBegin + 2s);
    QVERIFY(view.to() < RecordingBegin + 2s + 100ms);
    room.plots().setLive(false);
    QVERIFY(room.plots().timeWindow().pausedAt() > RecordingBegin + 3900ms); // but it can be gone to
}

void TestReplayWindow::standsAboveWhereItIsNarrow()
{
    Room room(m_path);
    room.window->resize(1400, 800);
    const auto *table = room.window->findChild<TablePanel *>();
    QTRY_VERIFY(table->geometry().right() <= room.plots().geometry().left());
    room.window->resize(900, 700);
    QTRY_VERIFY(table->geometry().bottom() <= room.plots().geometry().top());
    room.window->resize(1400, 800);
    QTRY_VERIFY(table->geometry().right() <= room.plots().geometry().left());
}

void TestReplayWindow::closesWhileItReads()
{
    for (int i = 0; i < 5; ++i) {
        Room room(m_path, false);
        QSignalSpy closed(room.window.get(), &ReplayWindow::closed);
        room.window->close();
        QCOMPARE(closed.count(), 1);
    }
}

void TestReplayWindow::spellsTimes_data()
{
    QTest::addColumn<qint64>("ms");
    QTest::addColumn<QString>("text");
    QTest::newRow("before") << qint64(-5) << u"0:00.000"_s;
    QTest::newRow("seconds") << qint64(7250) << u"0:07.250"_s;
    QTest::newRow("minutes") << qint64(62'001) << u"1:02.001"_s;
    QTest::newRow("hours") << qint64(3'727'250) << u"1:02:07.250"_s;
}

void TestReplayWindow::spellsTimes()
{
    QFETCH(qint64, ms);
    QFETCH(QString, text);
    QCOMPARE(replayTimeText(std::chrono::milliseconds(ms)), text);
}

void TestReplayWindow::takesDroppedRecordings()
{
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(u"/a/arm.MCAP"_s), QUrl::fromLocalFile(u"/a/b.csv"_s), QUrl(u"http://x/y.mcap"_s)});
    QCOMPARE(recordingsOf(data), QStringList{u"/a/arm.MCAP"_s});
}

DYNASCOPE_UI_TEST(TestReplayWindow)
#include "tst_replaywindow.moc"
