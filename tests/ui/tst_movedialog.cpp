// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/monitor.h"
#include "core/session/moves.h"
#include "core/session/scanner.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/uitest.h"
#include "tests/support/windowdriver.h"
#include "ui/devices/devicepanel.h"
#include "ui/devices/movedialog.h"
#include "ui/devices/movestepsmodel.h"
#include "ui/mainwindow.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTableWidget>
#include <QTreeView>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

constexpr int Slow = 57600, Fast = 1'000'000;
const QString Port = u"/dev/ttyVirtual"_s;

struct OnePort final : PortList {
    std::vector<PortInfo> ports() const override { return {{Port, u"U2D2"_s, {}}}; }
};

/// The window over a simulated bus that outlives it. Nothing is polled: virtual time would run without end.
struct World {
    World(VirtualFactory &factory, const Catalog &catalog)
        : session(factory, catalog)
        , commands(session, &journal)
        , monitor(session)
        , stop(session, commands)
        , window((monitor.setPaused(true), Workbench{session, commands, monitor, scanner, stop, ports}))
    {
        window.show();
        window.activateWindow();
    }
    bool connectTo(std::size_t devices)
    {
        window.connectTo(Port, Slow);
        return QTest::qWaitFor([&] { return session.devices().size() == devices && !scanner.isRunning(); });
    }
    MoveDialog *dialog() const
    {
        for (auto *each : window.findChildren<MoveDialog *>()) {
            if (each->isVisible())
                return each;
        }
        return nullptr;
    }
    template <typename Widget>
    Widget *part(const char *name) const
    {
        return dialog()->findChild<Widget *>(QLatin1String(name));
    }
    QString note() const { return part<QLabel>("note")->text(); }
    bool click(const char *name) const
    {
        auto *button = part<QPushButton>(name);
        if (!button || !button->isVisible() || !button->isEnabled())
            return false;
        test::WindowDriver::click(button);
        return true;
    }
    MoveRun::State state() const { return dialog()->run().state(); }
    /// By its key, with everybody selected; waits until it has looked.
    bool open() const
    {
        window.findChild<QTreeView *>(u"deviceTree"_s)->selectAll();
        QTest::keyClick(window.windowHandle(), Qt::Key_M, Qt::ControlModifier | Qt::ShiftModifier);
        return QTest::qWaitFor([&] { return dialog() && dialog()->run().isSurveyed(); })
               && QTest::qWaitForWindowActive(dialog());
    }
    Device *at(int id, int baudRate) const
    {
        return session.lines().front()->deviceAt(static_cast<std::uint8_t>(id), baudRate);
    }

    OnePort ports;
    Journal journal;
    Session session;
    Commands commands;
    Monitor monitor;
    Scanner scanner;
    StopControl stop;
    MainWindow window;
};

bool isWrite(ByteView packet)
{
    return packet[7] == static_cast<std::uint8_t>(Instruction::Write);
}

} // namespace

/// Moves of many devices at the window, by clicks and keys.
class TestMoveDialog : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        QDir(MoveFile::usualFolder()).removeRecursively();
        use(u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
    }
    void cleanup()
    {
        m_world.reset();
        m_factory.reset();
    }

    void aSwapByClicks()
    {
        QVERIFY(m_world->connectTo(2));
        const DeviceKey one = m_world->at(1, Slow)->key(), two = m_world->at(2, Slow)->key();
        QVERIFY(m_world->open());
        QVERIFY(!m_world->part<QPushButton>("acceptButton")->isEnabled()); // everybody stays
        QVERIFY(m_world->click("swapButton"));
        const QAbstractItemModel &steps = *m_world->part<QListView>("moveSteps")->model();
        QCOMPARE(steps.rowCount(), 3);
        const QString first = steps.index(0, 0).data().toString();
        QVERIFY2(first.contains(u"for a while, so that ID 1 is free"_s), qPrintable(first));
        QVERIFY2(m_world->note().startsWith(u"3 steps"_s), qPrintable(m_world->note()));
        QVERIFY(m_world->click("acceptButton"));
        QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
        QCOMPARE(m_world->session.device(one)->id(), 2);
        QCOMPARE(m_world->session.device(two)->id(), 1);
        for (int row = 0; row < steps.rowCount(); ++row)
            QVERIFY(steps.index(row, 0).data(Qt::AccessibleTextRole).toString().endsWith(u", done"_s));
        QVERIFY(m_world->note().contains(u"where they shall be"_s));
        QVERIFY(m_world->click("cancelButton")); // says Close
        QTRY_VERIFY(!m_world->dialog());
        m_world.reset();
        QCOMPARE(m_factory->simulated.servo(1, Slow)->model(), u"XL430-W250"_s);
    }

    void aNewIdByKeys()
    {
        QVERIFY(m_world->connectTo(2));
        QVERIFY(m_world->open());
        auto *id = m_world->part<QSpinBox>("newId1");
        id->setFocus();
        id->selectAll();
        test::WindowDriver::type(u"17"_s);
        QVERIFY(m_world->part<QPushButton>("acceptButton")->isEnabled());
        test::WindowDriver::key(Qt::Key_Return);
        QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
        QVERIFY(m_world->at(17, Slow));
        QCOMPARE(m_world->at(17, Slow)->model(), u"XL430-W250"_s);
    }

    /// One that is selected is no reason to leave the others out; who can't go along is named.
    void oneSelectedMeansAll()
    {
        use(u"XM430-W350@57600:1,XL330-M288@57600:2"_s);
        QVERIFY(m_world->connectTo(2));
        m_world->window.findChild<DevicePanel *>()->selectDevice(m_world->at(1, Slow));
        m_world->window.findChild<QAction *>(u"moveManyAction"_s)->trigger();
        QVERIFY(QTest::qWaitFor([this] { return m_world->dialog() && m_world->dialog()->run().isSurveyed(); }));
        QCOMPARE(m_world->part<QTableWidget>("moveTable")->rowCount(), 2);
        auto *baud = m_world->part<QComboBox>("allBaud");
        baud->setCurrentIndex(baud->findData(4'500'000));
        QVERIFY(m_world->click("allToBaudButton"));
        QVERIFY2(m_world->note().endsWith(u"XL330-M288 #2 can't work at 4.5 Mbps and is left where it is."_s),
                 qPrintable(m_world->note()));
        m_world->part<QSpinBox>("newId1")->setValue(9); // by hand
        QVERIFY2(!m_world->note().contains(u"4.5 Mbps"_s), qPrintable(m_world->note()));
    }

    void helpers()
    {
        QVERIFY(m_world->connectTo(2));
        QVERIFY(m_world->open());
        m_world->part<QSpinBox>("firstId")->setValue(20);
        QVERIFY(m_world->click("numberButton"));
        QCOMPARE(m_world->part<QSpinBox>("newId0")->value(), 20);
        QCOMPARE(m_world->part<QSpinBox>("newId1")->value(), 21);
        auto *baud = m_world->part<QComboBox>("allBaud");
        baud->setCurrentIndex(baud->findData(Fast));
        m_world->part<QTableWidget>("moveTable")->selectRow(1); // this one alone
        QVERIFY(!m_world->part<QPushButton>("swapButton")->isEnabled());
        QVERIFY(m_world->click("allToBaudButton"));
        QCOMPARE(m_world->part<QComboBox>("newBaud0")->currentData().toInt(), Slow);
        QCOMPARE(m_world->part<QComboBox>("newBaud1")->currentData().toInt(), Fast);
        QVERIFY2(m_world->note().contains(u"is parked"_s), qPrintable(m_world->note()));
        m_world->part<QSpinBox>("newId0")->setFocus(); // who types has selected nobody
        QTRY_VERIFY(!m_world->part<QTableWidget>("moveTable")->selectionModel()->hasSelection());
        QVERIFY(m_world->click("allToBaudButton"));
        QVERIFY2(m_world->note().contains(u"the line follows to 1 Mbps"_s), qPrintable(m_world->note()));
        QVERIFY(m_world->click("acceptButton"));
        QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
        QCOMPARE(m_world->session.lines().front()->baudRate(), Fast);
        QCOMPARE(m_world->at(21, Fast)->state(), Device::State::Present);
    }

    void problemsAreSaidBeforeAnythingIsWritten_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<int>("id");
        QTest::addColumn<QString>("says");
        QTest::newRow("taken") << u"XM430-W350@57600:1,XL430-W250@57600:2"_s << 2 << u"would both have ID 2"_s;
        QTest::newRow("a Secondary ID") << u"XM430-W350@57600:1,XL430-W250@57600:2"_s << 9
                                        << u"the Secondary ID of XL430-W250"_s;
    }
    void problemsAreSaidBeforeAnythingIsWritten()
    {
        QFETCH(QString, servos);
        QFETCH(int, id);
        QFETCH(QString, says);
        use(servos);
        m_factory->simulated.servo(2, Slow)->write(u"Secondary ID", 9);
        std::atomic<int> writes = 0;
        m_factory->onPacket = [&](int, ByteView packet) { writes += isWrite(packet) ? 1 : 0; };
        QVERIFY(m_world->connectTo(2));
        QVERIFY(m_world->open());
        m_world->part<QSpinBox>("newId0")->setValue(id);
        QVERIFY2(m_world->note().contains(says), qPrintable(m_world->note()));
        auto *accept = m_world->part<QPushButton>("acceptButton");
        QVERIFY(!accept->isEnabled());
        QVERIFY(accept->toolTip().contains(u"ID"_s)); // says why
        m_world->part<QSpinBox>("newId0")->setValue(40);
        QVERIFY(accept->isEnabled());
        m_world.reset();
        QCOMPARE(writes, 0);
        m_factory->onPacket = {};
    }

    void torqueIsAskedFor()
    {
        QVERIFY(m_world->connectTo(2));
        m_world->commands.setTorque({m_world->at(1, Slow)}, true);
        QTRY_VERIFY(m_world->at(1, Slow)->isTorqueOn());
        QVERIFY(m_world->open());
        m_world->part<QSpinBox>("newId0")->setValue(30);
        QVERIFY(!m_world->part<QPushButton>("acceptButton")->isEnabled());
        auto *box = m_world->part<QCheckBox>("turnTorqueOff");
        QVERIFY(box->isVisible());
        test::WindowDriver::click(box, QPoint(8, box->height() / 2));
        QVERIFY(m_world->click("acceptButton"));
        QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
        QVERIFY(m_world->at(30, Slow));
    }

    void stopEndsItAndItGoesOn()
    {
        QVERIFY(m_world->connectTo(2));
        QVERIFY(m_world->open());
        m_world->part<QSpinBox>("firstId")->setValue(20);
        QVERIFY(m_world->click("numberButton"));
        auto *steps = static_cast<MoveStepsModel *>(m_world->part<QListView>("moveSteps")->model());
        const auto press = connect(steps, &QAbstractItemModel::dataChanged, this, [&] {
            if (steps->progress(0) == MoveStepsModel::Progress::Done && !m_world->stop.isActive())
                test::WindowDriver::key(Qt::Key_Escape);
        });
        QVERIFY(m_world->click("acceptButton"));
        QTRY_COMPARE(m_world->state(), MoveRun::State::Halted);
        disconnect(press);
        QVERIFY(m_world->dialog()); // it says where it is
        QVERIFY(m_world->stop.isActive());
        QVERIFY2(m_world->note().contains(u"STOP"_s) || m_world->note().contains(u"as you wanted"_s),
                 qPrintable(m_world->note()));
        QCOMPARE(steps->progress(1), MoveStepsModel::Progress::Failed);
        QVERIFY(moveFileOf(Port, MoveFile::usualFolder()).exists());
        QTRY_VERIFY(!m_world->stop.isVerifying());
        m_world->stop.release();
        QTRY_VERIFY(m_world->part<QPushButton>("acceptButton")->isEnabled());
        QVERIFY(m_world->click("acceptButton")); // says Continue
        QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
        QVERIFY(m_world->at(20, Slow) && m_world->at(21, Slow));
        QVERIFY(!moveFileOf(Port, MoveFile::usualFolder()).exists());
    }

    void killedInItsMiddle_data()
    {
        QTest::addColumn<bool>("goesOn");
        QTest::newRow("continue") << true;
        QTest::newRow("forget") << false;
    }
    void killedInItsMiddle()
    {
        QFETCH(bool, goesOn);
        std::atomic<int> writes = 0;
        std::atomic<bool> dead = false;
        m_factory->isLost = [&](ByteView packet) {
            if (!dead)
                dead = isWrite(packet) && ++writes == 2;
            return dead.load();
        };
        QVERIFY(m_world->connectTo(2));
        QVERIFY(m_world->open());
        m_world->part<QSpinBox>("firstId")->setValue(20);
        QVERIFY(m_world->click("numberButton"));
        QVERIFY(m_world->click("acceptButton"));
        QTRY_VERIFY(dead);
        m_world.reset(); // whatever it came to is told nobody
        dead = false;
        writes = 100;
        m_world = std::make_unique<World>(*m_factory, m_catalog);
        QVERIFY(m_world->connectTo(2));
        const test::WindowDriver person(m_world->window);
        QTRY_VERIFY2(
            person.message().contains(u"a move of 2 devices was interrupted after step 1 of 2: XL430-W250 #2"_s),
            qPrintable(person.message()));
        QVERIFY(person.click(goesOn ? "messageAction" : "messageOther"));
        QTRY_VERIFY(!person.message().contains(u"was interrupted"_s));
        if (goesOn) {
            QTRY_VERIFY(m_world->dialog());
            QTRY_COMPARE(m_world->state(), MoveRun::State::Halted); // it has looked
            QCOMPARE(m_world->part<QTableWidget>("moveTable")->rowCount(), 2);
            QVERIFY(m_world->click("acceptButton"));
            QTRY_COMPARE(m_world->state(), MoveRun::State::Over);
            QVERIFY(m_world->at(21, Slow));
        } else {
            QVERIFY(!m_world->dialog());
            QVERIFY(m_world->at(2, Slow));
        }
        QVERIFY(!moveFileOf(Port, MoveFile::usualFolder()).exists());
        m_world.reset();
        QCOMPARE(m_factory->simulated.servo(goesOn ? 21 : 2, Slow)->model(), u"XL430-W250"_s);
    }

    void stepsAreASoundModel()
    {
        MoveStepsModel model;
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        MovePlan plan;
        plan.devices.resize(1);
        plan.steps = {{0, {Slow, 1}, {Slow, 2}, false}, {0, {Slow, 2}, {Fast, 2}, false}};
        model.setPlan(plan, Slow, MoveRun::State::Idle, {});
        QVERIFY(model.index(1, 0).data().toString().contains(u"reaches it no more"_s));
        plan.next = 1;
        model.setPlan(plan, Slow, MoveRun::State::Halted, u"it is gone"_s);
        QCOMPARE(model.progress(0), MoveStepsModel::Progress::Done);
        QCOMPARE(model.progress(1), MoveStepsModel::Progress::Failed);
        QVERIFY(model.index(1, 0).data(Qt::AccessibleTextRole).toString().endsWith(u"failed: it is gone"_s));
        model.setPlan({}, Slow, MoveRun::State::Idle, {});
        QCOMPARE(model.rowCount(), 0);
    }

private:
    void use(const QString &servos)
    {
        m_world.reset();
        m_factory = std::make_unique<VirtualFactory>(m_catalog, servos);
        m_world = std::make_unique<World>(*m_factory, m_catalog);
        QVERIFY(QTest::qWaitForWindowActive(&m_world->window));
    }

    const Catalog m_catalog = Catalog::builtIn().value();
    std::unique_ptr<VirtualFactory> m_factory;
    std::unique_ptr<World> m_world;
};

DYNASCOPE_UI_TEST(TestMoveDialog)
#include "tst_movedialog.moc"
