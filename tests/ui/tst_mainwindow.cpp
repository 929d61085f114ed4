// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/plot/plotarea.h"
#include "ui/table/tablepanel.h"
#include "ui/window/layoutmanager.h"
#include "ui/window/welcomepage.h"

#include <QAction>
#include <QFileDialog>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QTreeView>

using namespace dynascope;

class TestMainWindow : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        open();
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void beginsWithTheWelcome()
    {
        QVERIFY(find<WelcomePage>("welcomePage")->isVisible());
        QVERIFY(!find<DevicePanel>("devicePanel")->isVisible());
        QTest::mouseClick(find<QPushButton>("welcomeSimulate"), Qt::LeftButton);
        QTRY_VERIFY(find<DevicePanel>("devicePanel")->isVisible());
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QCOMPARE(m_bench->session.lines().front()->name(), QStringLiteral("sim"));
        QCOMPARE(m_bench->session.lines().front()->baudRate(), 1000000);
    }

    void reopensTheLastPort()
    {
        m_window->connectTo({}, 0);
        QVERIFY(m_bench->session.lines().empty());
        connectNow();
        m_window.reset();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        open();
        m_window->connectTo({}, 0);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
    }

    void theFirstDeviceIsSelectedAndRead()
    {
        connectNow();
        auto *devices = find<DevicePanel>("devicePanel");
        QCOMPARE(devices->selectedDevices().size(), std::size_t(1));
        Device *device = devices->selectedDevices().front();
        QTRY_COMPARE(device->raw(u"Model Number"), device->modelNumber());
        QTRY_VERIFY(device->raw(u"Present Position").has_value());
    }

    void escStopsFromAnywhere()
    {
        connectNow();
        const auto release = [this] {
            QVERIFY(m_bench->stop.isActive());
            m_bench->stop.release();
            QCoreApplication::processEvents();
        };
        QTest::keyClick(m_window->windowHandle(), Qt::Key_Escape);
        release();

        auto *port = m_window->findChild<QLineEdit *>(); // an editor
        port->setFocus();
        QTest::keyClick(port, Qt::Key_Escape);
        release();

        find<QAction>("changeIdAction")->trigger();
        auto *dialog = find<QDialog>("changeIdDialog");
        QTRY_VERIFY(dialog->isVisible());
        const QPointer<QDialog> watch(dialog);
        QTest::keyClick(dialog, Qt::Key_Escape);
        release();
        QTRY_VERIFY(!watch); // and it closes, as Esc does

        auto *tree = find<QTreeView>("deviceTree");
        emit tree->customContextMenuRequested(QPoint(5, 5));
        auto *menu = find<QMenu>("deviceMenu");
        QTRY_VERIFY(menu->isVisible());
        QTest::keyClick(menu, Qt::Key_Escape);
        release();
    }

    void stopIsReportedUntilItIsReleased()
    {
        connectNow();
        auto *bar = find<MessageBar>("stopBar");
        QVERIFY(bar->isHidden());
        m_bench->stop.press();
        QVERIFY(!bar->isHidden());
        QTRY_VERIFY(bar->text().contains(QStringLiteral("off on 3")));
        find<QAction>("torqueOnAction")->trigger(); // refused, and it says why
        QTRY_VERIFY(find<MessageBar>("messageBar")->text().contains(QStringLiteral("STOP is held")));
        QVERIFY(!selected()->isTorqueOn());
        QTest::mouseClick(bar->findChild<QPushButton *>(QStringLiteral("messageAction")), Qt::LeftButton);
        QVERIFY(!m_bench->stop.isActive());
        QVERIFY(bar->isHidden());
    }

    void asksOnceBeforeClosingOnTorque()
    {
        connectNow();
        Device *device = selected();
        find<QAction>("torqueOnAction")->trigger();
        QTRY_VERIFY(device->isTorqueOn());
        QCoreApplication::processEvents();
        m_window->close();
        QVERIFY(m_window->isVisible());
        auto *box = find<QMessageBox>("torqueBox");
        m_window->close(); // no second box
        QCOMPARE(m_window->findChildren<QMessageBox *>().size(), 1);
        QTest::mouseClick(box->findChild<QPushButton *>(QStringLiteral("leaveTorqueButton")), Qt::LeftButton);
        QTRY_VERIFY(!m_window->isVisible());
        QVERIFY(device->isTorqueOn()); // untouched
    }

    void mayTurnItOffAndClose()
    {
        connectNow();
        Device *device = selected();
        m_bench->commands.writeField(*device, device->table().indexOf(u"Torque Enable"), 1); // as the table does
        QTRY_VERIFY(device->isTorqueOn());
        m_window->close();
        QTest::mouseClick(
            find<QMessageBox>("torqueBox")->findChild<QPushButton *>(QStringLiteral("turnTorqueOffButton")),
            Qt::LeftButton);
        QTRY_VERIFY(!m_window->isVisible());
        QVERIFY(!device->isTorqueOn());
    }

    void closesWithoutAWordOtherwise()
    {
        connectNow();
        m_window->close();
        QVERIFY(!m_window->isVisible());
    }

    void rebootAsksOnlyUnderTorque()
    {
        connectNow();
        Device *device = selected();
        find<QAction>("rebootAction")->trigger();
        QVERIFY(!m_window->findChild<QMessageBox *>(QStringLiteral("confirmBox")));
        QTRY_COMPARE(device->state(), Device::State::Rebooting);
        QTRY_COMPARE(device->state(), Device::State::Present);
        find<QAction>("torqueOnAction")->trigger();
        QTRY_VERIFY(device->isTorqueOn());
        find<QAction>("rebootAction")->trigger();
        auto *box = find<QMessageBox>("confirmBox");
        QVERIFY(box->text().contains(device->displayName()));
        box->reject();
        QCOMPARE(device->state(), Device::State::Present);
    }

    void aPulledPlugIsSaidOnce()
    {
        connectNow();
        auto *messages = find<MessageBar>("messageBar");
        m_bench->lines.unplug();
        QTRY_VERIFY(messages->text().contains(QStringLiteral("is gone")));
        QCOMPARE(messages->count(), 1);
        QCOMPARE(messages->kind(), MessageKind::Error);
        QVERIFY(find<DevicePanel>("devicePanel")->isVisible()); // the devices stay, greyed
        QVERIFY(!find<QAction>("torqueOnAction")->isEnabled());
    }

    void aLineThatIsBackIsNoLongerSaidToBeGone()
    {
        connectNow();
        auto *messages = find<MessageBar>("messageBar");
        m_bench->lines.unplug();
        QTRY_VERIFY(messages->text().contains(QStringLiteral("is gone")));
        m_bench->lines.unplug(false);
        QTRY_VERIFY(messages->text().contains(QStringLiteral("is back")));
        messages->dismiss();
        QVERIFY(!messages->text().contains(QStringLiteral("is gone")));
    }

    void aFailedWriteIsSaidWhereItStands()
    {
        connectNow();
        auto *messages = find<MessageBar>("messageBar");
        messages->clear();
        Device *device = selected();
        const Error error{ErrorKind::NothingReceived, QStringLiteral("ID 1 did not answer"), 0};
        emit m_bench->commands.failed(device, error, 3);
        QVERIFY(messages->text().isEmpty()); // the table shows it
        device->setFailed(3, error.text);
        emit m_bench->commands.failed(device, error); // another thing, which failed the same way
        QVERIFY2(messages->text().endsWith(QStringLiteral("ID 1 did not answer")), qPrintable(messages->text()));
        messages->clear();
        emit m_bench->commands.failed(m_bench->device(4, 1000000), error, 3); // not the one shown
        QVERIFY2(messages->text().startsWith(QStringLiteral("XL430-W250, ID 4")), qPrintable(messages->text()));
    }

    void whatComesBackIsReadAgain()
    {
        connectNow();
        Device *device = selected();
        const int id = device->table().indexOf(u"ID"); // EEPROM: nobody polls it
        QTRY_COMPARE(device->value(id).state, FieldState::Fresh);
        m_bench->lines.unplug();
        QTRY_COMPARE(device->value(id).state, FieldState::Stale);
        m_bench->lines.unplug(false);
        QTRY_COMPARE(device->value(id).state, FieldState::Fresh);

        device->setState(Device::State::Silent);
        QCOMPARE(device->value(id).state, FieldState::Stale);
        device->setState(Device::State::Present);
        QTRY_COMPARE(device->value(id).state, FieldState::Fresh);
    }

    void workAtThisBaud()
    {
        connectNow();
        auto *panel = find<DevicePanel>("devicePanel");
        panel->selectDevice(m_bench->device(1, 57600));
        auto *action = find<QAction>("workAtBaudAction");
        QVERIFY(action->isEnabled());
        action->trigger();
        QTRY_COMPARE(m_bench->session.lines().front()->baudRate(), 57600);
        QCOMPARE(m_bench->device(1, 57600)->state(), Device::State::Present);
        QVERIFY(!action->isEnabled());
    }

    void plotsGoWhereTheyFitUntilAPersonSays()
    {
        auto *layout = m_window->findChild<LayoutManager *>();
        m_window->resize(1400, 800);
        QCOMPARE(layout->plotPlace(), PlotPlace::Right);
        m_window->resize(900, 600);
        QCOMPARE(m_window->size(), QSize(900, 600));
        QCOMPARE(layout->plotPlace(), PlotPlace::Below);
        find<QAction>("plotsRightAction")->trigger();
        QCOMPARE(layout->plotPlace(), PlotPlace::Right);
        m_window->resize(1000, 700);
        QCOMPARE(layout->plotPlace(), PlotPlace::Right);
        m_window->close();
        open();
        QCOMPARE(m_window->findChild<LayoutManager *>()->plotPlace(), PlotPlace::Right);
        QCOMPARE(m_window->size(), QSize(1000, 700));
        find<QAction>("resetLayoutAction")->trigger();
        QVERIFY(m_window->findChild<LayoutManager *>()->plotPlace() == PlotPlace::Below || m_window->width() >= 1200);
    }

    void theColumnsOfOneDeviceFitBesideThePlots()
    {
        m_window->resize(1440, 900);
        connectNow();
        auto *table = find<QTreeView>("tableView");
        QTRY_VERIFY(table->header()->count() > 0);
        QCOMPARE(table->horizontalScrollBar()->maximum(), 0);
        // No heading is cut off, nor a name.
        const QFontMetrics metrics(table->font());
        const QAbstractItemModel &model = *table->model();
        for (int column = 0; column < model.columnCount(); ++column) {
            const QString heading = model.headerData(column, Qt::Horizontal).toString();
            QVERIFY2(metrics.horizontalAdvance(heading) + 16 <= table->columnWidth(column) || column == 1,
                qPrintable(heading)); // the second is centred and has no margin
        }
        for (int group = 0; group < model.rowCount(); ++group) {
            const QModelIndex parent = model.index(group, 0);
            for (int row = 0; row < model.rowCount(parent); ++row) {
                const QString name = model.index(row, 0, parent).data().toString();
                const int room = table->columnWidth(0) - 2 * table->indentation() - 8;
                QVERIFY2(name.startsWith(u"Indirect") || metrics.horizontalAdvance(name) <= room, qPrintable(name));
            }
        }
        m_window->resize(1300, 900);
        QVERIFY(m_window->findChild<PlotArea *>()->width() >= 364); // the plots keep what they need
    }

    void plotsAreSavedFromTheFileMenu()
    {
        connectNow();
        QAction *csv = find<QAction>("saveCsvAction");
        const QAction *file = m_window->menuBar()->actions().front();
        QVERIFY(file->menu()->actions().contains(csv));
        QVERIFY(file->menu()->actions().contains(find<QAction>("savePictureAction")));
        QVERIFY(!csv->isEnabled()); // nothing is plotted
        const Device *device = selected();
        m_window->findChild<PlotArea *>()->addTrace({device->key(), device->table().indexOf(u"Present Position")});
        QVERIFY(csv->isEnabled());
        QTest::keyClick(m_window.get(), Qt::Key_S, Qt::ControlModifier);
        QVERIFY(m_window->findChild<QFileDialog *>());
    }

    void remembersTheScheme()
    {
        QSignalSpy asked(m_window.get(), &MainWindow::schemeRequested);
        find<QAction>("schemeDarkAction")->trigger();
        QCOMPARE(asked.count(), 1);
        QCOMPARE(savedColorScheme(), ColorScheme::Dark);
        open();
        QVERIFY(find<QAction>("schemeDarkAction")->isChecked());
    }

    void demoCanBeResumedOnTheSimulatedBusOnly()
    {
        QVERIFY(!find<QAction>("resumeDemoAction")->isEnabled());
        QSignalSpy resumed(m_window.get(), &MainWindow::resumeDemoRequested);
        m_window->connectTo(QStringLiteral("/dev/ttyUSB0"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QVERIFY(!find<QAction>("resumeDemoAction")->isEnabled());
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_VERIFY(find<QAction>("resumeDemoAction")->isEnabled());
        find<QAction>("resumeDemoAction")->trigger();
        QCOMPARE(resumed.count(), 1);
    }

    void everyActionHasAKeyOrSitsInAMenuAndNoKeyTwice()
    {
        QHash<QString, QString> seen;
        for (const QAction *action : m_window->findChildren<QAction *>()) {
            const QString key = action->shortcut().toString();
            if (key.isEmpty() || action->shortcutContext() != Qt::WindowShortcut)
                continue;
            QVERIFY2(!seen.contains(key),
                qPrintable(QStringLiteral("%1: %2, %3").arg(key, seen.value(key), action->text())));
            seen.insert(key, action->text());
        }
        QVERIFY(seen.size() > 15);
        for (const auto *button : m_window->findChildren<QAbstractButton *>()) {
            const bool named = !button->text().isEmpty() || !button->accessibleName().isEmpty();
            QVERIFY2(named || !button->isVisible(), qPrintable(button->objectName()));
        }
    }

private:
    void open()
    {
        m_window.reset();
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    }

    void connectNow()
    {
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QTRY_VERIFY(selected() && selected()->raw(u"Present Position").has_value());
    }

    Device *selected()
    {
        const auto devices = find<DevicePanel>("devicePanel")->selectedDevices();
        return devices.empty() ? nullptr : devices.front();
    }

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

DYNASCOPE_UI_TEST(TestMainWindow)
#include "tst_mainwindow.moc"
