// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/deviceactions.h"

#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalSpy>
#include <QTreeWidget>

using namespace dynascope;

class TestDeviceActions : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_line = &m_bench->session.open(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        m_bench->scanner.start(*m_line, {{1000000}, 0, 252});
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(2));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        m_window = std::make_unique<QWidget>();
        m_window->show();
        m_actions = new DeviceActions(m_bench->workbench(), m_window.get());
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void readAllIsOneJobADevice()
    {
        const std::vector<Device *> devices = m_bench->session.devices();
        select(devices);
        trigger("readAllAction");
        for (const Device *device : devices)
            QTRY_VERIFY(device->raw(u"Present Temperature"));
        m_bench->lines.unplug(); // each job that is there fails
        QSignalSpy failed(&m_bench->commands, &Commands::failed);
        for (int press = 0; press < 5; ++press)
            trigger("readAllAction");
        QTRY_VERIFY(m_line->state() != BusThread::State::Open);
        QTRY_COMPARE(failed.count(), 2);
        QCoreApplication::processEvents();
        QCOMPARE(failed.count(), 2);
    }

    void theLineCanFollowADeviceThatHasMoved()
    {
        Device &device = *m_bench->session.devices().front();
        m_actions->setSelection({&device}, m_line, 1000000);
        auto *action = m_actions->findChild<QAction *>(QStringLiteral("workAtBaudAction"));
        QVERIFY(!action->isEnabled());
        m_line->moveDevice(device, {9, 57600, 1020, 45, false, {}}); // while it is selected
        m_actions->update();
        QVERIFY(action->isEnabled());
        trigger("workAtBaudAction");
        QTRY_COMPARE(m_line->baudRate(), 57600);
    }

    void whatIsDoneIsDoneToAllThatAreSelected()
    {
        const std::vector<Device *> devices = m_bench->session.devices(); // of different models
        select(devices);
        trigger("identifyAction");
        for (const Device *device : devices)
            QTRY_COMPARE(device->raw(u"LED"), 1);
        trigger("torqueOnAction");
        auto *box = m_window->findChild<QMessageBox *>(QStringLiteral("confirmBox"));
        QVERIFY(box);
        for (const Device *device : devices)
            QVERIFY2(box->text().contains(device->displayName()), qPrintable(box->text()));
        m_actions->setSelection({devices.front()}, m_line, 1000000); // meanwhile
        QTest::mouseClick(box->findChild<QPushButton *>(QStringLiteral("confirmButton")), Qt::LeftButton);
        for (const Device *device : devices)
            QTRY_VERIFY(device->isTorqueOn());
        select(devices);
        trigger("torqueOffAction");
        for (const Device *device : devices)
            QTRY_VERIFY(!device->isTorqueOn());
        QTRY_VERIFY(!m_window->findChild<QMessageBox *>(QStringLiteral("confirmBox")));
        trigger("rebootAction");
        box = m_window->findChild<QMessageBox *>(QStringLiteral("confirmBox"));
        QVERIFY(box);
        QVERIFY2(box->text().contains(QStringLiteral("EEPROM, ID and baud rate stay")), qPrintable(box->text()));
        QTest::mouseClick(box->findChild<QPushButton *>(QStringLiteral("confirmButton")), Qt::LeftButton);
        for (const Device *device : devices)
            QTRY_COMPARE(device->state(), Device::State::Rebooting);
    }

    void severalAreResetOneAfterTheOther()
    {
        m_window.reset();
        m_bench = std::make_unique<test::WorkbenchFixture>(QStringLiteral("XM430-W350@1000000:1,XL430-W250@1000000:4"));
        m_line = &m_bench->session.open(QStringLiteral("sim"), 1000000);
        m_line->heard({1, 1000000, 1020, 45, false, {}});
        m_line->heard({4, 1000000, 1060, 45, false, {}});
        m_window = std::make_unique<QWidget>();
        m_window->show();
        m_actions = new DeviceActions(m_bench->workbench(), m_window.get());
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        const std::vector<Device *> devices = m_bench->session.devices();
        select(devices);
        trigger("factoryResetAction");
        auto *dialog = m_window->findChild<QDialog *>(QStringLiteral("resetManyDialog"));
        QVERIFY(dialog);
        const auto part = [dialog](const char *name) { return dialog->findChild<QWidget *>(QLatin1String(name)); };
        const auto note = [&] { return qobject_cast<QLabel *>(part("note"))->text(); };
        auto *list = qobject_cast<QTreeWidget *>(part("resetList"));
        QCOMPARE(list->topLevelItem(1)->text(2), list->topLevelItem(1)->text(1)); // it stays where it is
        qobject_cast<QRadioButton *>(part("resetAll"))->click(); // both to ID 1
        QVERIFY(!part("acceptButton")->isEnabled());
        QVERIFY2(note().contains(QStringLiteral("would both end at ID 1 at 57\u2009600 bps")), qPrintable(note()));
        qobject_cast<QRadioButton *>(part("resetKeepId"))->click();
        QVERIFY2(note().contains(QStringLiteral("At the end the line follows to 57")), qPrintable(note()));
        QVERIFY(list->topLevelItem(1)->text(2).startsWith(QStringLiteral("ID 4 at 57")));
        QTest::mouseClick(part("acceptButton"), Qt::LeftButton);
        for (const Device *device : devices)
            QTRY_COMPARE_WITH_TIMEOUT(device->baudRate(), 57600, 10000); // found there by itself
        QTRY_COMPARE(m_line->baudRate(), 57600);
        QCOMPARE(m_bench->session.devices(), devices);
    }

    void hybridRegistersAreSaved()
    {
        QVERIFY(!m_actions->findChild<QAction *>(QStringLiteral("saveHybridAction"))->isVisible()); // no X has any
        m_window.reset();
        m_bench = std::make_unique<test::WorkbenchFixture>(QStringLiteral("YM070-210-M001-RH@1000000:1"));
        m_line = &m_bench->session.open(QStringLiteral("sim"), 1000000);
        Device &device = m_line->heard({1, 1000000, 4000, 11, false, {}});
        m_window = std::make_unique<QWidget>();
        m_actions = new DeviceActions(m_bench->workbench(), m_window.get());
        QStringList said;
        connect(m_actions, &DeviceActions::posted, this, [&](const Message &message) { said << message.text; });
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        select({&device});
        trigger("torqueOnAction");
        QTRY_VERIFY(device.isTorqueOn());
        trigger("saveHybridAction");
        QVERIFY(said.size() == 1 && said.front().contains(QStringLiteral("only with torque off")));
        trigger("torqueOffAction");
        QTRY_VERIFY(!device.isTorqueOn());
        QSignalSpy failed(&m_bench->commands, &Commands::failed);
        trigger("saveHybridAction");
        QTRY_VERIFY(said.size() == 2 || !failed.isEmpty());
        if (!failed.isEmpty())
            QFAIL(qPrintable(failed.front().at(1).value<Error>().text));
        QCOMPARE(said.size(), 2);
        QVERIFY2(said.back().contains(QStringLiteral("has saved")), qPrintable(said.back()));
        QCOMPARE(device.raw(u"Hybrid Save"), std::optional<std::int64_t>(2));
    }

private:
    void select(const std::vector<Device *> &devices) { m_actions->setSelection(devices, m_line, 1000000); }
    void trigger(const char *name) const
    {
        auto *action = m_actions->findChild<QAction *>(QString::fromLatin1(name));
        QVERIFY(action && action->isEnabled());
        action->trigger();
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<QWidget> m_window;
    LineSession *m_line = nullptr;
    DeviceActions *m_actions = nullptr;
};

DYNASCOPE_UI_TEST(TestDeviceActions)
#include "tst_deviceactions.moc"
