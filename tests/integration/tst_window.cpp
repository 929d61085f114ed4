// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/workshop.h"
#include "core/sim/servo.h"
#include "tests/support/uitest.h"
#include "ui/devices/devicepanel.h"
#include "ui/plot/plotarea.h"
#include "ui/table/tableroles.h"

#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QToolButton>
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
        auto catalog = Catalog::builtIn();
        QVERIFY2(catalog, catalog ? "" : qPrintable(catalog.error().text));
        m_catalog = std::move(*catalog);
    }

    void init()
    {
        QSettings().clear();
        m_link = m_directory.filePath(QStringLiteral("bus"));
        plugIn();
        m_workshop = std::make_unique<Workshop>(*qApp, WindowOptions());
        window().resize(1400, 900);
        window().show();
        window().activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&window()));
    }

    void cleanup()
    {
        m_workshop.reset();
        m_server.reset();
    }

    void connectingScansAndFillsTheTree()
    {
        QVERIFY(child<QWidget>("welcomePage")->isVisible());
        auto *port = child<QComboBox>("portCombo");
        port->setEditText(m_link);
        QTest::mouseClick(child<QAbstractButton>("connectButton"), Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(devices().size(), std::size_t(3), 20000);
        auto *tree = child<QAbstractItemView>("deviceTree");
        QTRY_VERIFY(tree->isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(!m_workshop->scanner().isRunning(), 20000);
        QCOMPARE(tree->model()->rowCount(), 1); // one line
        const QModelIndex line = tree->model()->index(0, 0);
        QCOMPARE(tree->model()->rowCount(line), 2); // two baud rates
    }

    void aScanCanBeCancelled()
    {
        connectAndFind();
        QTest::mouseClick(child<QAbstractButton>("scanButton"), Qt::LeftButton);
        QTRY_VERIFY(m_workshop->scanner().isRunning());
        QTRY_VERIFY(child<QAbstractButton>("scanCancel")->isVisible());
        QTest::mouseClick(child<QAbstractButton>("scanCancel"), Qt::LeftButton);
        QTRY_VERIFY(!m_workshop->scanner().isRunning());
    }

    void aGoalTypedIntoTheTableMovesTheJoint()
    {
        Device &device = selectFirst();
        trigger("torqueOn");
        QTRY_VERIFY(device.isTorqueOn());
        const Watch watch{device.key(), device.table().indexOf(u"Present Position")};
        window().findChild<PlotArea *>()->addTrace(watch);
        QTRY_VERIFY(device.raw(u"Present Position").has_value());
        const std::int64_t goal = *device.raw(u"Present Position") > 2048 ? 1024 : 3072;
        editField(device, u"Goal Position", QString::number(goal));
        QTRY_COMPARE(device.raw(u"Goal Position"), goal);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(*device.raw(u"Present Position") - goal) < 40, 5000);
        const History *history = m_workshop->monitor().history(watch);
        QVERIFY(history);
        std::int32_t least = 0;
        std::int32_t most = 0;
        QVERIFY(history->range(LineTime::min(), LineTime::max(), least, most));
        QVERIFY(most - least > 500);
    }

    void aValueThatDoesNotFitIsNotWritten()
    {
        Device &device = selectFirst();
        QTRY_VERIFY(device.raw(u"Goal Position").has_value());
        const std::int64_t before = *device.raw(u"Goal Position");
        editField(device, u"Goal Position", QStringLiteral("99999"));
        QVERIFY(editor()); // still open: it says why
        QTest::keyClick(editor(), Qt::Key_Escape); // leaves the editor, and presses STOP
        QTRY_VERIFY(!editor());
        m_workshop->stop().release();
        QCOMPARE(truth(1, u"Goal Position"), before);
    }

    void changesAnIdThroughTheDialog()
    {
        Device &device = selectFirst();
        const DeviceKey key = device.key();
        trigger("changeId");
        QTRY_VERIFY(child<QDialog>("changeIdDialog"));
        child<QSpinBox>("newId")->setValue(42);
        QTest::mouseClick(child<QAbstractButton>("acceptButton"), Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(device.id(), 42, 5000);
        QCOMPARE(m_workshop->session().device(key), &device);
        QTRY_VERIFY2(messageText().contains(QStringLiteral("now has ID 42")), qPrintable(messageText()));
        QCOMPARE(truth(42, u"ID"), 42);
    }

    void refusesATakenIdInTheDialog()
    {
        selectFirst();
        trigger("changeId");
        QTRY_VERIFY(child<QDialog>("changeIdDialog"));
        child<QSpinBox>("newId")->setValue(2);
        QVERIFY(!child<QAbstractButton>("acceptButton")->isEnabled());
        child<QDialog>("changeIdDialog")->reject();
    }

    void changesABaudRateThroughTheDialog()
    {
        Device &device = selectFirst();
        trigger("changeBaud");
        QTRY_VERIFY(child<QDialog>("changeBaudDialog"));
        auto *rates = child<QComboBox>("newBaud");
        const int at = rates->findData(2000000);
        QVERIFY(at >= 0);
        rates->setCurrentIndex(at);
        QTest::mouseClick(child<QAbstractButton>("acceptButton"), Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(device.baudRate(), 2000000, 5000);
        QCOMPARE(device.state(), Device::State::Parked); // the other one stays where it was
        QTRY_VERIFY(messageText().contains(QStringLiteral("2000000")) || messageText().contains(QStringLiteral("2 M")));
    }

    void escapeStops_data()
    {
        QTest::addColumn<QString>("open");
        QTest::newRow("with nothing open") << QString();
        QTest::newRow("in an editor") << QStringLiteral("editor");
        QTest::newRow("in a dialog") << QStringLiteral("dialog");
        QTest::newRow("in a menu") << QStringLiteral("menu");
    }
    void escapeStops()
    {
        QFETCH(QString, open);
        Device &device = selectFirst();
        trigger("torqueOn");
        QTRY_VERIFY(device.isTorqueOn());
        QWidget *receiver = &window();
        QMenu menu;
        if (open == QLatin1String("editor")) {
            QVERIFY(openEditor(device, u"Goal Position"));
            receiver = editor();
        } else if (open == QLatin1String("dialog")) {
            trigger("changeId");
            QTRY_VERIFY(child<QDialog>("changeIdDialog"));
            receiver = child<QDialog>("changeIdDialog");
        } else if (open == QLatin1String("menu")) {
            menu.addAction(QStringLiteral("something"));
            menu.popup(window().mapToGlobal(QPoint(10, 10)));
            receiver = &menu;
        }
        QTest::keyClick(receiver, Qt::Key_Escape);
        QVERIFY(m_workshop->stop().isActive());
        QTRY_VERIFY(m_workshop->stop().isConfirmed());
        QCOMPARE(truth(1, u"Torque Enable"), 0);
        if (open == QLatin1String("dialog")) // Esc has kept its usual meaning
            QTRY_VERIFY(!child<QDialog>("changeIdDialog") || !child<QDialog>("changeIdDialog")->isVisible());
        if (open == QLatin1String("menu"))
            QVERIFY(!menu.isVisible());
        m_workshop->stop().release();
    }

    void theStopButtonHoldsUntilReleased()
    {
        Device &device = selectFirst();
        trigger("torqueOn");
        QTRY_VERIFY(device.isTorqueOn());
        auto *button = child<QAbstractButton>("stopButton");
        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_VERIFY(m_workshop->stop().isConfirmed());
        QTRY_VERIFY(!device.isTorqueOn());
        QTRY_VERIFY(!window().findChild<QAction *>(QStringLiteral("torqueOnAction"))->isEnabled());
        QCOMPARE(truth(1, u"Torque Enable"), 0);
        QTest::mouseClick(button, Qt::LeftButton); // releases
        QVERIFY(!m_workshop->stop().isActive());
        trigger("torqueOn");
        QTRY_VERIFY(device.isTorqueOn());
    }

    void aPulledPlugIsSaidAndTakenUpAgain()
    {
        Device &device = selectFirst();
        QTRY_VERIFY(device.raw(u"Present Position").has_value());
        m_server.reset();
        QTRY_COMPARE_WITH_TIMEOUT(m_workshop->session().lines().front()->state(), BusThread::State::Lost, 5000);
        QTRY_VERIFY(!messageText().isEmpty());
        QCOMPARE(devices().size(), std::size_t(3)); // nothing is lost on screen
        plugIn();
        QTRY_COMPARE_WITH_TIMEOUT(m_workshop->session().lines().front()->state(), BusThread::State::Open, 10000);
    }

private:
    MainWindow &window() { return m_workshop->window(); }

    template <typename Widget>
    Widget *child(const char *name)
    {
        const auto found = window().findChildren<Widget *>(QString::fromLatin1(name));
        return found.isEmpty() ? nullptr : found.constLast();
    }

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

    void connectAndFind()
    {
        window().connectTo(m_link, 57600);
        QTRY_COMPARE_WITH_TIMEOUT(devices().size(), std::size_t(3), 20000);
        m_workshop->scanner().cancel(); // all are found: no need to try the other rates
        QTRY_VERIFY(!m_workshop->scanner().isRunning());
    }

    Device &selectFirst()
    {
        connectAndFind();
        Device *device = devices().front();
        child<DevicePanel>("devicePanel")->selectDevice(device);
        return *device;
    }

    std::vector<Device *> devices() const { return m_workshop->session().devices(); }

    void trigger(const char *name)
    {
        auto *action = window().findChild<QAction *>(QString::fromLatin1(name) + QStringLiteral("Action"));
        QVERIFY2(action, name);
        QTRY_VERIFY2(action->isEnabled(), name);
        action->trigger();
    }

    QString messageText()
    {
        QStringList texts;
        for (const QLabel *label : window().findChildren<QLabel *>(QStringLiteral("messageText")))
            texts << label->text();
        return texts.join(QLatin1Char(' ')).trimmed();
    }

    /// The cell of a register's value, scrolled into view.
    QModelIndex cellOf(const Device &device, QStringView name)
    {
        auto *view = child<QAbstractItemView>("tableView");
        child<QLineEdit>("tableSearch")->setText(name.toString());
        const QAbstractItemModel *model = view->model();
        const QModelIndexList rows = model->match(model->index(0, 0), Qt::DisplayRole, name.toString(), 1,
                                                  Qt::MatchExactly | Qt::MatchRecursive);
        if (rows.isEmpty() || !device.table().find(name))
            return {};
        for (int column = 0; column < model->columnCount(); ++column) {
            const QModelIndex cell = rows.constFirst().siblingAtColumn(column);
            if (cell.flags().testFlag(Qt::ItemIsEditable)) {
                view->scrollTo(cell);
                view->setCurrentIndex(cell);
                return cell;
            }
        }
        return {};
    }

    bool openEditor(const Device &device, QStringView name)
    {
        QModelIndex cell;
        if (!QTest::qWaitFor([&] { return (cell = cellOf(device, name)).isValid(); }))
            return false;
        auto *view = child<QAbstractItemView>("tableView");
        view->setFocus();
        QTest::keyClick(view, Qt::Key_F2);
        return QTest::qWaitFor([&] { return editor() != nullptr; });
    }

    QLineEdit *editor() { return child<QAbstractItemView>("tableView")->findChild<QLineEdit *>(QStringLiteral("valueEdit")); }

    QString whereFocusIs()
    {
        const QWidget *focus = QApplication::focusWidget();
        auto *view = child<QAbstractItemView>("tableView");
        return QStringLiteral("focus in %1, current row %2, %3 rows, search %4")
            .arg(focus ? QString::fromLatin1(focus->metaObject()->className()) + QLatin1Char(32) + focus->objectName() + QStringLiteral(" in ")
                             + focus->window()->objectName()
                       : QStringLiteral("nothing"),
                 view->currentIndex().siblingAtColumn(0).data().toString())
            .arg(view->model()->rowCount())
            .arg(child<QLineEdit>("tableSearch")->text());
    }

    void editField(const Device &device, QStringView name, const QString &text)
    {
        QVERIFY2(openEditor(device, name), qPrintable(whereFocusIs()));
        editor()->selectAll();
        QTest::keyClicks(editor(), text);
        QTest::keyClick(editor(), Qt::Key_Return);
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
    Catalog m_catalog;
    std::unique_ptr<sim::PtyServer> m_server;
    std::unique_ptr<Workshop> m_workshop;
};

DYNASCOPE_UI_TEST(TestWindow)
#include "tst_window.moc"
