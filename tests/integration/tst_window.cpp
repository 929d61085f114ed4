// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/workshop.h"
#include "core/sim/servo.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/uitest.h"
#include "tests/support/windowdriver.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDialog>
#include <QFileDialog>
#include <QSettings>
#include <QTemporaryDir>
#include <QTreeView>

using namespace dynascope;

/// The real window over a pty opened by QSerialPort, driven by keys and clicks.
class TestWindow : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(m_directory.isValid());
    }

    void init()
    {
        QSettings().clear();
        m_link = m_directory.filePath(QStringLiteral("bus"));
        plugIn();
        m_workshop = std::make_unique<Workshop>(*qApp, WindowOptions());
        m_person = std::make_unique<test::WindowDriver>(window());
        window().resize(1400, 900);
        window().show();
        window().activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&window()));
    }

    void cleanup()
    {
        m_person.reset();
        m_workshop.reset();
        m_server.reset();
    }

    void connectingScansAndFillsTheTree()
    {
        QVERIFY(m_person->child<QWidget>("welcomePage"));
        connectAndFind();
        QTRY_VERIFY_WITH_TIMEOUT(!m_workshop->scanner().isRunning(), 20000);
        auto *tree = m_person->child<QTreeView>("deviceTree");
        QVERIFY(tree);
        QCOMPARE(tree->model()->rowCount(), 1); // one line
        QCOMPARE(tree->model()->rowCount(tree->model()->index(0, 0)), 2); // two baud rates
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("3 devices found")), qPrintable(m_person->message()));
    }

    void aScanIsCancelledByItsButton()
    {
        selectFirst();
        QVERIFY(m_person->click("scanButton"));
        QTRY_VERIFY(m_workshop->scanner().isRunning());
        QTRY_VERIFY(m_person->child<QWidget>("scanCancel"));
        QVERIFY(m_person->click("scanCancel"));
        QTRY_VERIFY(!m_workshop->scanner().isRunning());
        QVERIFY(m_workshop->scanner().wasCancelled());
    }

    void aGoalTypedIntoTheTableMovesTheTraceOnThePlot()
    {
        Device &device = selectFirst();
        torqueOn(device);
        QVERIFY(m_person->clickCell(QStringLiteral("Present Position"), ColumnKind::Plot));
        QTRY_VERIFY(m_person->paintedHeight() >= 0);
        QVERIFY2(m_person->paintedHeight() < 0.1, "it stands still: a level trace");
        const std::int64_t goal = device.raw(u"Present Position").value_or(0) > 2048 ? 1024 : 3072;
        QVERIFY(m_person->edit(QStringLiteral("Goal Position"), QString::number(goal)));
        QTRY_COMPARE(device.raw(u"Goal Position"), goal);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(*device.raw(u"Present Position") - goal) < 40, 5000);
        QTRY_VERIFY(m_person->paintedHeight() > 0.5);
        QVERIFY(m_person->clickCell(QStringLiteral("Present Position"), ColumnKind::Plot)); // unticked
        QTRY_VERIFY(m_person->paintedHeight() < 0);
    }

    void aValueThatDoesNotFitIsNotWritten()
    {
        Device &device = selectFirst();
        QTRY_VERIFY(device.raw(u"Goal Position").has_value());
        const std::int64_t before = truth(1, u"Goal Position");
        QVERIFY(m_person->edit(QStringLiteral("Goal Position"), QStringLiteral("99999")));
        QVERIFY(m_person->editor()); // still open: it says why
        m_person->key(Qt::Key_Escape); // leaves the editor, and presses STOP
        QTRY_VERIFY(!m_person->editor());
        QCOMPARE(truth(1, u"Goal Position"), before);
    }

    void changesAnIdThroughTheDialog()
    {
        Device &device = selectFirst();
        const DeviceKey key = device.key();
        openDialog(device, "changeIdAction", "changeIdDialog");
        m_person->type(QStringLiteral("42")); // the number has the focus and is selected
        m_person->key(Qt::Key_Return);
        QTRY_COMPARE_WITH_TIMEOUT(device.id(), 42, 5000);
        QCOMPARE(m_workshop->session().device(key), &device);
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("now has ID 42")), qPrintable(m_person->message()));
        QCOMPARE(truth(42, u"ID"), 42);
    }

    void refusesATakenIdInTheDialog()
    {
        Device &device = selectFirst();
        openDialog(device, "changeIdAction", "changeIdDialog");
        m_person->type(QStringLiteral("2"));
        QVERIFY(!m_person->child<QAbstractButton>("acceptButton")->isEnabled());
        m_person->key(Qt::Key_Return);
        QVERIFY(m_person->child<QDialog>("changeIdDialog"));
        QCOMPARE(truth(1, u"ID"), 1);
    }

    void changesABaudRateThroughTheDialog()
    {
        Device &device = selectFirst();
        openDialog(device, "changeBaudAction", "changeBaudDialog");
        auto *rates = m_person->child<QComboBox>("newBaud");
        const int wanted = rates->findData(2000000);
        QVERIFY(wanted >= 0);
        m_person->click(rates);
        QTRY_VERIFY(QApplication::activePopupWidget());
        QAbstractItemView *list = rates->view();
        list->scrollTo(list->model()->index(wanted, 0));
        m_person->click(list->viewport(), list->visualRect(list->model()->index(wanted, 0)).center());
        QTRY_COMPARE(rates->currentIndex(), wanted);
        QVERIFY(m_person->click("acceptButton"));
        QTRY_COMPARE_WITH_TIMEOUT(device.baudRate(), 2000000, 5000);
        QCOMPARE(device.state(), Device::State::Parked); // the other one stays where it was
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("now works at 2 Mbps")),
                     qPrintable(m_person->message()));
    }

    void escapeStops_data()
    {
        QTest::addColumn<QString>("open");
        QTest::newRow("with nothing open") << QString();
        QTest::newRow("in an editor") << QStringLiteral("editor");
        QTest::newRow("in a dialog") << QStringLiteral("dialog");
        QTest::newRow("in the menu bar's menu") << QStringLiteral("menu");
        QTest::newRow("in a context menu") << QStringLiteral("context menu");
        QTest::newRow("in an editor's list") << QStringLiteral("list");
        QTest::newRow("in the check list of bits") << QStringLiteral("bits");
        QTest::newRow("in the scan options") << QStringLiteral("scan options");
        QTest::newRow("in the save dialog") << QStringLiteral("save dialog");
    }
    void escapeStops()
    {
        QFETCH(QString, open);
        Device &device = selectFirst();
        if (open == u"bits") { // of a register that is locked under torque: somebody else turns it on meanwhile
            QTRY_VERIFY(device.raw(u"Shutdown"));
            openCell(QStringLiteral("Shutdown"), "bitPopup");
            m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->write(u"Torque Enable", 1); });
            QTRY_VERIFY(device.isTorqueOn());
        } else {
            torqueOn(device);
        }
        if (open == u"editor")
            QVERIFY(m_person->openEditor(QStringLiteral("Goal Position")));
        else if (open == u"dialog")
            openDialog(device, "changeIdAction", "changeIdDialog");
        else if (open == u"menu")
            QVERIFY(m_person->openMenu(QStringLiteral("Device")));
        else if (open == u"context menu")
            QVERIFY(m_person->clickDevice(device, Qt::RightButton) && QApplication::activePopupWidget());
        else if (open == u"list")
            openCell(QStringLiteral("Status Return Level"), "enumEdit");
        else if (open == u"scan options")
            QVERIFY(m_person->click("scanOptionsButton"));
        else if (open == u"save dialog")
            openSaveDialog();
        if (open == u"list" || open == u"bits" || open == u"scan options")
            QTRY_VERIFY(QApplication::activePopupWidget());
        m_person->key(Qt::Key_Escape);
        QVERIFY(m_workshop->stop().isActive());
        QTRY_VERIFY(m_workshop->stop().isConfirmed());
        QCOMPARE(truth(1, u"Torque Enable"), 0);
        // Esc has kept its usual meaning.
        QTRY_VERIFY(!m_person->editor() && !m_person->child<QComboBox>("enumEdit"));
        QTRY_VERIFY(!m_person->child<QDialog>("changeIdDialog") && !m_person->child<QDialog>("saveDialog"));
        QVERIFY(!QApplication::activePopupWidget());
    }

    void theStopButtonHoldsUntilReleased()
    {
        Device &device = selectFirst();
        torqueOn(device);
        QVERIFY(m_person->click("stopButton"));
        QTRY_VERIFY(m_workshop->stop().isConfirmed());
        QTRY_VERIFY(!device.isTorqueOn());
        QVERIFY(m_person->pickForDevice(device, "torqueOnAction")); // refused, and said
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("STOP is held")), qPrintable(m_person->message()));
        QCOMPARE(truth(1, u"Torque Enable"), 0);
        QVERIFY(m_person->click("stopButton")); // releases
        QVERIFY(!m_workshop->stop().isActive());
        torqueOn(device);
    }

    void aPulledPlugIsSaidAndTakenUpAgain_data()
    {
        QTest::addColumn<QString>("open");
        QTest::newRow("with nothing open") << QString();
        QTest::newRow("with an editor open") << QStringLiteral("editor");
        QTest::newRow("with a dialog open") << QStringLiteral("dialog");
    }
    void aPulledPlugIsSaidAndTakenUpAgain()
    {
        QFETCH(QString, open);
        Device &device = selectFirst();
        QTRY_VERIFY(device.raw(u"Profile Velocity").has_value());
        if (open == u"editor") {
            QVERIFY(m_person->openEditor(QStringLiteral("Profile Velocity")));
            m_person->type(QStringLiteral("55"));
        } else if (open == u"dialog") {
            openDialog(device, "changeIdAction", "changeIdDialog");
        }
        m_server.reset();
        QTRY_COMPARE_WITH_TIMEOUT(line().state(), BusThread::State::Lost, 5000);
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("is gone")), qPrintable(m_person->message()));
        QCOMPARE(devices().size(), std::size_t(3)); // nothing is lost on screen
        if (open == u"editor") {
            QVERIFY(m_person->editor() && m_person->editor()->text() == QStringLiteral("55"));
            m_person->key(Qt::Key_Return); // to nobody
            QTRY_VERIFY(!m_person->editor());
        } else if (open == u"dialog") {
            QVERIFY(!m_person->child<QAbstractButton>("acceptButton")->isEnabled());
        }
        plugIn();
        QTRY_COMPARE_WITH_TIMEOUT(line().state(), BusThread::State::Open, 10000);
        QTRY_VERIFY(!m_person->message().contains(QStringLiteral("is gone")));
        const int velocity = device.table().indexOf(u"Profile Velocity");
        QTRY_COMPARE_WITH_TIMEOUT(device.value(velocity).state, FieldState::Fresh, 5000);
        QCOMPARE(truth(1, u"Profile Velocity"), 0); // nothing was kept for it
        if (open == u"dialog") {
            QTRY_VERIFY(m_person->child<QAbstractButton>("acceptButton")->isEnabled());
            m_person->key(Qt::Key_Escape);
            m_workshop->stop().release();
            window().activateWindow(); // there is no window manager to do it
            QVERIFY(QTest::qWaitForWindowActive(&window()));
        }
        QVERIFY(m_person->edit(QStringLiteral("Profile Velocity"), QStringLiteral("77")));
        QTRY_COMPARE(device.raw(u"Profile Velocity"), 77);
        QCOMPARE(truth(1, u"Profile Velocity"), 77);
    }

    void aDeviceThatVanishesWhileItIsEdited()
    {
        Device &device = selectFirst();
        QTRY_VERIFY(device.raw(u"Profile Velocity").has_value());
        QVERIFY(m_person->openEditor(QStringLiteral("Profile Velocity")));
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setPlugged(false); });
        m_person->type(QStringLiteral("55"));
        m_person->key(Qt::Key_Return);
        const int velocity = device.table().indexOf(u"Profile Velocity");
        QTRY_COMPARE_WITH_TIMEOUT(device.value(velocity).state, FieldState::Failed, 5000);
        QVERIFY(!device.value(velocity).error.isEmpty());
        QTRY_COMPARE_WITH_TIMEOUT(device.state(), Device::State::Silent, 5000);
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setPlugged(true); });
        QTRY_COMPARE_WITH_TIMEOUT(device.state(), Device::State::Present, 10000);
        QVERIFY(m_person->edit(QStringLiteral("Profile Velocity"), QStringLiteral("77")));
        QTRY_COMPARE(truth(1, u"Profile Velocity"), 77);
    }

    void aDeviceThatVanishesBehindItsDialog()
    {
        Device &device = selectFirst();
        openDialog(device, "changeIdAction", "changeIdDialog");
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setPlugged(false); });
        m_person->type(QStringLiteral("42"));
        QVERIFY(m_person->click("acceptButton"));
        QTRY_VERIFY2(m_person->message().contains(QStringLiteral("not answer")), qPrintable(m_person->message()));
        QCOMPARE(device.id(), 1);
    }

private:
    MainWindow &window() { return m_workshop->window(); }
    LineSession &line() const { return *m_workshop->session().lines().front(); }
    std::vector<Device *> devices() const { return m_workshop->session().devices(); }

    void plugIn()
    {
        auto bus = std::make_unique<sim::SimulatedBus>(m_catalog);
        const auto specs = sim::parseServoSpecs(
            u"XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288@1000000:1", m_catalog);
        QVERIFY(specs);
        for (const sim::ServoSpec &spec : *specs)
            QVERIFY(bus->add(spec));
        auto server = sim::PtyServer::start(std::move(bus), m_link);
        QVERIFY2(server, server ? "" : qPrintable(server.error().text));
        m_server = std::move(*server);
    }

    /// Types the port and connects; ends when all have been found.
    void connectAndFind()
    {
        auto *port = m_person->child<QComboBox>("portCombo");
        m_person->click(port->lineEdit());
        m_person->key(Qt::Key_A, Qt::ControlModifier);
        m_person->type(m_link);
        QVERIFY(m_person->click("connectButton"));
        QTRY_COMPARE_WITH_TIMEOUT(devices().size(), std::size_t(3), 20000);
        QTRY_VERIFY(m_person->child<QTreeView>("deviceTree"));
    }

    /// All are found: no need to try the other rates.
    Device &selectFirst()
    {
        connectAndFind();
        m_person->click("scanCancel");
        [this] { QTRY_VERIFY(!m_workshop->scanner().isRunning()); }();
        Device *device = devices().front();
        [&] { QVERIFY(m_person->clickDevice(*device)); }();
        return *device;
    }

    void torqueOn(const Device &device)
    {
        QVERIFY(m_person->pickForDevice(device, "torqueOnAction"));
        QTRY_VERIFY(device.isTorqueOn());
    }

    void openDialog(const Device &device, const char *action, const char *name)
    {
        QVERIFY(m_person->pickForDevice(device, action));
        QTRY_VERIFY(m_person->child<QDialog>(name));
        QVERIFY(QTest::qWaitForWindowActive(m_person->child<QDialog>(name)));
    }

    /// By Enter on the row, which opens what its kind of register is edited with.
    void openCell(const QString &field, const char *name)
    {
        QVERIFY(m_person->clickCell(field, ColumnKind::Value));
        m_person->key(Qt::Key_Return);
        QTRY_VERIFY(m_person->child<QWidget>(name));
    }

    void openSaveDialog()
    {
        QVERIFY(m_person->clickCell(QStringLiteral("Present Position"), ColumnKind::Plot));
        m_person->key(Qt::Key_S, Qt::ControlModifier);
        auto *dialog = m_person->child<QFileDialog>("saveDialog");
        QVERIFY(dialog);
        QVERIFY(dialog->testOption(QFileDialog::DontUseNativeDialog)); // whose keys nobody here would see
        QVERIFY(QTest::qWaitForWindowActive(dialog));
    }

    std::int64_t truth(int id, QStringView name)
    {
        std::int64_t value = -1;
        m_server->call([&](sim::SimulatedBus &bus, LineTime) {
            if (sim::Servo *servo = bus.servo(id, 57600))
                value = servo->value(name);
        });
        return value;
    }

    QTemporaryDir m_directory;
    QString m_link;
    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<sim::PtyServer> m_server;
    std::unique_ptr<Workshop> m_workshop;
    std::unique_ptr<test::WindowDriver> m_person;
};

DYNASCOPE_UI_TEST(TestWindow)
#include "tst_window.moc"
