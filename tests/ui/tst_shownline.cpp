// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/elidedlabel.h"
#include "ui/common/messagebar.h"
#include "ui/connection/connector.h"
#include "ui/connection/portcombo.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QTreeView>

using namespace dynascope;

/// Which of several lines the window tells about, and what it says of each.
class TestShownLine : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void anOpenLineIsToldOfThoughAnotherPortIsChosen()
    {
        connectTo(QStringLiteral("sim"), 3);
        ports()->setPort(QStringLiteral("/dev/ttyUSB7"));
        QVERIFY2(status().contains(QStringLiteral("Simulated bus")), qPrintable(status()));
        const QString state = find<ElidedLabel>("connectionState")->text();
        QVERIFY2(state.contains(QStringLiteral("Simulated bus")), qPrintable(state));
        QVERIFY(m_window->windowTitle().startsWith(QStringLiteral("sim")));
    }

    void selectingADeviceMakesItsLineCurrent()
    {
        connectTo(QStringLiteral("sim"), 3);
        connectTo(QStringLiteral("/dev/ttyUSB0"), 6);
        QVERIFY2(status().contains(QStringLiteral("ttyUSB0")), qPrintable(status()));
        auto *panel = m_window->findChild<DevicePanel *>();
        panel->selectDevice(m_bench->session.lines().front()->devices().front().get());
        QCOMPARE(ports()->port(), QStringLiteral("sim"));
        QVERIFY2(status().contains(QStringLiteral("Simulated bus")), qPrintable(status()));
        panel->selectDevice(m_bench->session.lines().back()->devices().front().get());
        QCOMPARE(ports()->port(), QStringLiteral("/dev/ttyUSB0"));
    }

    void whatIsBeingTypedStays()
    {
        connectTo(QStringLiteral("sim"), 3);
        connectTo(QStringLiteral("/dev/ttyUSB0"), 6);
        find<QAction>("choosePortAction")->trigger();
        QTest::keyClicks(ports()->lineEdit(), QStringLiteral("/dev/pts/3"));
        m_window->findChild<DevicePanel *>()->selectDevice(m_bench->session.lines().front()->devices().front().get());
        QCOMPARE(ports()->port(), QStringLiteral("/dev/pts/3"));
    }

    void aTypedPathIsListedWhileItIsOpen()
    {
        const QString path = QStringLiteral("/dev/pts/99");
        connectTo(path, 3);
        QVERIFY(ports()->findData(path) >= 0);
        ports()->setPort(QStringLiteral("sim"));
        ports()->setCurrentIndex(ports()->findData(path));
        QCOMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Disconnect"));
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QTRY_VERIFY(m_bench->session.lines().empty());
        QCoreApplication::processEvents();
        QCOMPARE(ports()->findData(path), -1);
    }

    void aLineIsClosedFromTheTree()
    {
        connectTo(QStringLiteral("sim"), 3);
        connectTo(QStringLiteral("/dev/ttyUSB0"), 6);
        auto *tree = find<QTreeView>("deviceTree");
        tree->setCurrentIndex(tree->model()->index(0, 0));
        emit tree->customContextMenuRequested(QPoint(5, 5));
        auto *menu = find<QMenu>("deviceMenu");
        auto *close = menu->findChild<QAction *>(QStringLiteral("disconnectLineAction"));
        QVERIFY(close && close->text().contains(QStringLiteral("Simulated bus")));
        close->trigger();
        menu->close();
        QTRY_COMPARE(m_bench->session.lines().size(), std::size_t(1));
        QCOMPARE(m_bench->session.lines().front()->name(), QStringLiteral("/dev/ttyUSB0"));
    }

    void aLineWithNobodyOnItIsClosedWhereItsDevicesWouldBe()
    {
        connectTo(QStringLiteral("sim"), 3);
        while (!m_bench->session.devices().empty())
            m_bench->session.lines().front()->forget(m_bench->session.devices().front()->key());
        ports()->setPort(QStringLiteral("/dev/ttyUSB0"));
        auto *button = find<QPushButton>("emptyDisconnectButton");
        QTRY_VERIFY(button->isVisible());
        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_VERIFY(m_bench->session.lines().empty());
    }

    void anErrorOfOnePortGoesWhenAnotherIsOpen()
    {
        m_window->connectTo(QStringLiteral("/dev/forbidden"), 57600);
        auto *messages = find<MessageBar>("messageBar");
        QTRY_VERIFY2(messages->text().contains(QStringLiteral("No permission")), qPrintable(messages->text()));
        connectTo(QStringLiteral("sim"), 3);
        QVERIFY2(!messages->text().contains(QStringLiteral("No permission")), qPrintable(messages->text()));
        messages->dismiss();
        QVERIFY2(!messages->text().contains(QStringLiteral("No permission")), qPrintable(messages->text()));
    }

    void thePortIsTypedAfterItsKey()
    {
        QTest::keyClick(m_window->windowHandle(), Qt::Key_L, Qt::ControlModifier);
        QVERIFY(!QApplication::activePopupWidget());
        QVERIFY(ports()->lineEdit()->hasFocus());
        for (const char key : QByteArray("/dev/ttyUSB9"))
            QTest::keyClick(m_window->windowHandle(), key);
        QTest::keyClick(m_window->windowHandle(), Qt::Key_Return);
        QTRY_COMPARE(m_bench->session.lines().size(), std::size_t(1));
        QCOMPARE(m_bench->session.lines().front()->name(), QStringLiteral("/dev/ttyUSB9"));
    }

    void theSearchIsReachedFromAnywhere()
    {
        connectTo(QStringLiteral("sim"), 3);
        find<QTreeView>("deviceTree")->setFocus();
        QTest::keyClick(m_window->windowHandle(), Qt::Key_F, Qt::ControlModifier);
        QCOMPARE(QApplication::focusWidget(), find<QLineEdit>("tableSearch"));
    }

    void withoutAConnectionThatIsWhyNothingCanBeWritten()
    {
        connectTo(QStringLiteral("sim"), 3);
        Device *device = m_bench->device(1, 1000000);
        m_window->findChild<DevicePanel *>()->selectDevice(device);
        QTRY_VERIFY(device->raw(u"Present Position").has_value()); // all of it was read
        m_bench->commands.setTorque({device}, true);
        auto *slider = find<QSlider>("goalSlider");
        QTRY_VERIFY(device->isTorqueOn());
        QTRY_VERIFY(device->raw(u"Goal Position").has_value());
        QTRY_VERIFY(slider->isEnabled());
        m_bench->lines.unplug();
        QTRY_VERIFY(device->line()->state() != BusThread::State::Open);
        QCOMPARE(device->lockReason(device->table().indexOf(u"Shutdown")),
                 QStringLiteral("XM430-W350 #1 is not connected."));
        QTRY_VERIFY(!slider->isEnabled());
        auto *view = find<TableView>("tableView");
        const QModelIndexList rows =
            view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, QStringLiteral("Shutdown"), 1,
                                 Qt::MatchExactly | Qt::MatchRecursive);
        QCOMPARE(rows.size(), 1);
        view->setCurrentIndex(rows.front());
        QTest::keyClick(view, Qt::Key_Return);
        QTRY_VERIFY(find<QWidget>("lockBar")->isVisible());
        QVERIFY(!find<QPushButton>("lockBarButton")->isVisible()); // turning torque off is no way
    }

    void whatWasNotWrittenStaysToBeRead()
    {
        connectTo(QStringLiteral("sim"), 3);
        auto *messages = find<MessageBar>("messageBar");
        emit m_window->findChild<TablePanel *>()->notWritten(QStringLiteral("Not written: it is too large."));
        QCOMPARE(messages->kind(), MessageKind::Error);
    }

    void aScanThatFindsNobodySaysWhere()
    {
        connectTo(QStringLiteral("sim"), 3);
        auto *connector = m_window->findChild<Connector *>();
        auto *messages = find<MessageBar>("messageBar");
        messages->clear();
        connector->scan(*m_bench->session.lines().front(), {{115200, 2000000, 3000000}, 0, 252});
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QTRY_VERIFY2(messages->text().startsWith(QStringLiteral(
                         "No device answered on Simulated bus at 115\u2009200 bps, 2 Mbps and 3 Mbps")),
                     qPrintable(messages->text()));
    }

private:
    void connectTo(const QString &port, std::size_t devices)
    {
        m_window->connectTo(port, 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), devices);
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QCoreApplication::processEvents();
    }

    PortCombo *ports() { return find<PortCombo>("portCombo"); }
    QString status() { return find<ElidedLabel>("statusLine")->text(); }

    template <typename T>
    T *find(const char *name)
    {
        T *child = m_window->findChild<T *>(QString::fromLatin1(name));
        if (!child)
            qFatal("no %s", name);
        return child;
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
};

DYNASCOPE_UI_TEST(TestShownLine)
#include "tst_shownline.moc"
