// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settingscommands.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "tests/ui/tablewindow.h"
#include "ui/devices/deviceactions.h"
#include "ui/table/consequencesdialog.h"
#include "ui/window/torqueguard.h"

#include <QCheckBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>

using namespace dynascope;
using namespace Qt::StringLiterals;

/// What is told before a write, and the ways out of it, with clicks and keys, on simulated servos.
class TestConsequences : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>(u"XM430-W350@1000000:1,XL430-W250@1000000:4"_s);
        m_settings = std::make_unique<SettingsCommands>(m_bench->session, m_bench->commands);
        LineSession &line = m_bench->session.open(u"sim"_s, 1'000'000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        m_device = &line.heard({1, 1'000'000, 1020, 45, false, {}});
        m_window = std::make_unique<TableWindow>(tableActions(workbench()));
        m_window->panel.setDevices({m_device});
        refresh();
        QTRY_VERIFY(m_device->raw(u"Present Position"));
    }
    void cleanup()
    {
        m_window.reset();
        m_settings.reset();
        m_bench.reset();
    }

    void aModeThatResetsGains_data()
    {
        QTest::addColumn<QString>("way");
        QTest::addColumn<int>("mode");
        QTest::addColumn<int>("gain");
        QTest::newRow("the safe way, by Enter") << u"Enter"_s << 4 << 640;
        QTest::newRow("the safe way, by a click") << u"writeSafely"_s << 4 << 640;
        QTest::newRow("write only") << u"writeOnly"_s << 4 << 800;
        QTest::newRow("Esc") << u"Esc"_s << 3 << 640;
    }
    void aModeThatResetsGains()
    {
        QFETCH(QString, way);
        QVERIFY(write(u"Position P Gain", 640));
        m_window->go(u"Operating Mode"_s);
        edit(u"Operating Mode"_s, 4);
        QPointer<QDialog> asked = dialog();
        QVERIFY(asked);
        QCOMPARE(asked->windowModality(), Qt::NonModal);
        QVERIFY(texts(*asked).contains(u"Position P Gain: 640 → 800"_s));
        const QString steps = asked->findChild<QLabel *>(u"safeSteps"_s)->text();
        QCOMPARE(steps, u"1. keep the values of the registers that will be reset\n"
                        "2. write Operating Mode, and read it back\n3. put the kept values back"_s);
        QVERIFY(!asked->findChild<QCheckBox *>(u"torqueBack"_s));
        QVERIFY(asked->findChild<QPushButton *>(u"writeSafely"_s)->isDefault());
        QTest::qWait(0);
        QCOMPARE(m_device->raw(u"Operating Mode").value_or(-1), 3);
        choose(*asked, way);
        QTRY_VERIFY(!asked);
        QTRY_VERIFY(!m_device->value(m_device->table().indexOf(u"Operating Mode")).pending);
        refresh();
        QTRY_COMPARE(m_device->raw(u"Operating Mode").value_or(-1), QLatin1String(QTest::currentDataTag()) == QLatin1String("Esc") ? 3 : 4);
        QTEST(static_cast<int>(m_device->raw(u"Operating Mode").value_or(-1)), "mode");
        QTRY_COMPARE(static_cast<int>(m_device->raw(u"Position P Gain").value_or(-1)), gain());
    }

    void whatIsLockedByTorque_data()
    {
        QTest::addColumn<bool>("tick");
        QTest::newRow("torque stays off") << false;
        QTest::newRow("torque comes back") << true;
    }
    void whatIsLockedByTorque()
    {
        QFETCH(bool, tick);
        QVERIFY(write(u"Torque Enable", 1));
        QWidget owner;
        TorqueGuard guard(workbench(), &owner);
        guard.noteEnabled({m_device->key()});
        m_window->go(u"Current Limit"_s);
        QTest::keyClick(m_window->view, Qt::Key_F2);
        auto *other = m_window->find<QPushButton>("lockBarOther");
        QTRY_VERIFY(other->isVisible());
        QVERIFY(!m_window->edit());
        QTest::mouseClick(other, Qt::LeftButton);
        QTRY_VERIFY(m_window->edit());
        m_window->edit()->selectAll();
        QTest::keyClicks(m_window->edit(), u"500"_s);
        QTest::keyClick(m_window->edit(), Qt::Key_Return);
        QTRY_VERIFY(dialog());
        QPointer<QDialog> asked = dialog();
        QVERIFY(texts(*asked).contains(u"what the motor carries may fall"_s));
        QVERIFY(!asked->findChild<QPushButton *>(u"writeOnly"_s)->isEnabled());
        auto *back = asked->findChild<QCheckBox *>(u"torqueBack"_s);
        QVERIFY(back && !back->isChecked());
        if (tick)
            QTest::mouseClick(back, Qt::LeftButton, {}, {10, back->height() / 2});
        QCOMPARE(back->isChecked(), tick);
        choose(*asked, u"writeSafely"_s);
        QTRY_COMPARE(m_device->raw(u"Current Limit").value_or(-1), 500);
        QTRY_COMPARE(m_device->raw(u"Torque Enable").value_or(-1), tick ? 1 : 0);
        QTRY_COMPARE(guard.holding().size(), std::size_t(tick ? 1 : 0));
    }

    void writeOnlyOnceTorqueIsOff()
    {
        QVERIFY(write(u"Torque Enable", 1));
        askAboutConsequences({{m_device}, m_device->table().indexOf(u"Current Limit"), 500, {}, [](Device &) {},
                              [](Device &, bool) {}},
                             &m_window->panel);
        QPointer<QDialog> asked = dialog();
        QVERIFY(asked);
        auto *only = asked->findChild<QPushButton *>(u"writeOnly"_s);
        QVERIFY(!only->isEnabled());
        QVERIFY(write(u"Torque Enable", 0));
        QVERIFY(only->isEnabled());
    }

    void nothingIsAskedAboutALamp()
    {
        edit(u"LED"_s, 1);
        QVERIFY(!dialog());
        QTRY_COMPARE(m_device->raw(u"LED").value_or(-1), 1);
    }

    void goesWithItsDevice()
    {
        QVERIFY(write(u"Position P Gain", 640));
        edit(u"Operating Mode"_s, 4);
        QPointer<QDialog> asked = dialog();
        QVERIFY(asked);
        edit(u"Operating Mode"_s, 4); // again: the same one
        QCOMPARE(m_window->panel.findChildren<QDialog *>(u"consequencesDialog"_s).size(), 1);
        m_bench->session.close(*m_bench->session.lines().front());
        QTRY_VERIFY(!asked);
    }

    void torqueOnAwayFromTheGoal_data()
    {
        QTest::addColumn<QString>("way");
        QTest::addColumn<bool>("on");
        QTest::newRow("at rest") << u"Enter"_s << true;
        QTest::newRow("as it is") << u"writeOnly"_s << true;
        QTest::newRow("Esc") << u"Esc"_s << false;
    }
    void torqueOnAwayFromTheGoal()
    {
        QFETCH(QString, way);
        QFETCH(bool, on);
        QWidget owner;
        owner.show();
        DeviceActions actions(workbench(), &owner);
        TorqueGuard guard(workbench(), &owner);
        QObject::connect(&actions, &DeviceActions::torqueEnabled, &guard, &TorqueGuard::noteEnabled);
        actions.setSelection({m_device}, m_device->line(), 1'000'000);
        QVERIFY(write(u"Goal Position", 1000));
        actions.findChild<QAction *>(u"torqueOnAction"_s)->trigger();
        QPointer<QDialog> asked = owner.findChild<QDialog *>(u"consequencesDialog"_s);
        QVERIFY(asked);
        QVERIFY2(texts(*asked).contains(u"The joint may jump by -92"_s), qPrintable(texts(*asked)));
        QCOMPARE(m_device->raw(u"Torque Enable").value_or(-1), 0);
        choose(*asked, way);
        QTRY_VERIFY(!asked);
        QTRY_COMPARE(m_device->isTorqueOn(), on);
        QTRY_COMPARE(guard.holding().size(), std::size_t(on ? 1 : 0));
        if (way == u"Enter")
            QTRY_VERIFY(std::abs(m_device->raw(u"Goal Position").value_or(0) - 2048) < 20);
    }

    void torqueOnAtItsGoal()
    {
        QWidget owner;
        DeviceActions actions(workbench(), &owner);
        actions.setSelection({m_device}, m_device->line(), 1'000'000);
        QVERIFY(write(u"Goal Position", 2050));
        actions.findChild<QAction *>(u"torqueOnAction"_s)->trigger();
        QVERIFY(!owner.findChild<QDialog *>());
        QTRY_VERIFY(m_device->isTorqueOn());
    }

    void torqueOnOfSeveral()
    {
        QWidget owner;
        owner.show();
        Device &second = m_device->line()->heard({4, 1'000'000, 1060, 45, false, {}});
        DeviceActions actions(workbench(), &owner);
        actions.setSelection({m_device, &second}, m_device->line(), 1'000'000);
        QVERIFY(write(u"Goal Position", 1000));
        actions.findChild<QAction *>(u"torqueOnAction"_s)->trigger();
        auto *box = owner.findChild<QMessageBox *>(u"confirmBox"_s);
        QVERIFY(box);
        QVERIFY2(box->text().contains(u"The joint may jump by -92"_s), qPrintable(box->text()));
        box->reject();
    }

private:
    Workbench workbench()
    {
        Workbench made = m_bench->workbench();
        made.settings = m_settings.get();
        return made;
    }
    int gain() const { return QLatin1String(QTest::currentDataTag()) == QLatin1String("write only") ? 800 : 640; }
    void refresh()
    {
        std::optional<Result<void>> done;
        m_bench->commands.readAll(*m_device, [&](const Result<void> &result) { done = result; });
        QTRY_VERIFY(done);
    }
    bool write(QStringView name, int raw)
    {
        std::optional<Result<void>> done;
        m_bench->commands.writeField(*m_device, m_device->table().indexOf(name), raw,
                                     [&](const Result<void> &result) { done = result; });
        return QTest::qWaitFor([&] { return done.has_value(); }, 10000) && done->has_value();
    }
    void edit(const QString &name, int raw)
    {
        m_window->view->model()->setData(m_window->cell(name, ColumnKind::Value), raw, Qt::EditRole);
    }
    QDialog *dialog() const { return m_window->find<QDialog>("consequencesDialog"); }
    static QString texts(const QDialog &dialog)
    {
        QStringList all;
        for (const QLabel *label : dialog.findChildren<QLabel *>(u"consequence"_s))
            all << label->text();
        return all.join(u'\n');
    }
    static void choose(QDialog &dialog, const QString &way)
    {
        if (way == u"Enter")
            QTest::keyClick(&dialog, Qt::Key_Return);
        else if (way == u"Esc")
            QTest::keyClick(&dialog, Qt::Key_Escape);
        else
            QTest::mouseClick(dialog.findChild<QPushButton *>(way), Qt::LeftButton);
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<SettingsCommands> m_settings;
    std::unique_ptr<TableWindow> m_window;
    Device *m_device = nullptr;
};

DYNASCOPE_UI_TEST(TestConsequences)
#include "tst_consequences.moc"
