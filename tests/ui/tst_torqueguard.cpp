// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/window/torqueguard.h"

#include <QWidget>

using namespace dynascope;

/// Whose torque was turned on here; the question itself is in tst_mainwindow.
class TestTorqueGuard : public QObject
{
    Q_OBJECT

private slots:
    void remembersWhatWasTurnedOnHere_data()
    {
        QTest::addColumn<int>("driveMode");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("value");
        QTest::addColumn<bool>("holds");
        QTest::newRow("Torque Enable") << 0 << QStringLiteral("Torque Enable") << 1 << true;
        QTest::newRow("a goal that waits for it") << 0 << QStringLiteral("Goal Position") << 2000 << false;
        QTest::newRow("a goal that turns it on") << 8 << QStringLiteral("Goal Position") << 2000 << true;
        QTest::newRow("no goal") << 8 << QStringLiteral("Profile Velocity") << 20 << false;
    }
    void remembersWhatWasTurnedOnHere()
    {
        QFETCH(int, driveMode);
        QFETCH(QString, field);
        QFETCH(int, value);
        test::WorkbenchFixture bench;
        QWidget window;
        TorqueGuard guard(bench.workbench(), &window);
        LineSession &line = bench.session.open(QStringLiteral("sim"), 1'000'000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        Device &device = line.heard({1, 1'000'000, 1020, 45, false, {}});
        const auto write = [&](QStringView name, int raw) {
            std::optional<Result<void>> done;
            bench.commands.writeField(device, device.table().indexOf(name), raw,
                                      [&](const Result<void> &result) { done = result; });
            return QTest::qWaitFor([&] { return done.has_value(); }, 10000) && done->has_value();
        };
        QVERIFY(write(u"Drive Mode", driveMode));
        QVERIFY(write(field, value));
        QTEST(device.isTorqueOn(), "holds"); // read back at once
        QTEST(!guard.holding().empty(), "holds");
        if (device.isTorqueOn()) {
            QVERIFY(write(u"Torque Enable", 0));
            QVERIFY(guard.holding().empty());
        }
    }

    void countsWhatNobodyCouldReadBack()
    {
        test::WorkbenchFixture bench;
        QWidget window;
        TorqueGuard guard(bench.workbench(), &window);
        LineSession &line = bench.session.open(QStringLiteral("sim"), 1'000'000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        Device &device = line.heard({1, 1'000'000, 1020, 45, false, {}});
        const int torque = device.table().indexOf(Known::TorqueEnable);
        device.takeReadBack(torque, 0);
        device.setPending(torque, 1);
        QVERIFY(guard.holding().empty());
        device.setUnconfirmed(torque, 1, QStringLiteral("nothing came back"));
        QCOMPARE(guard.holding().size(), std::size_t(1));
        guard.noteEnabled({device.key()}); // as after "Torque on" for several
        device.setUnconfirmed(torque, 1, QStringLiteral("nothing came back"));
        QCOMPARE(guard.holding().size(), std::size_t(1));
        device.takeReadBack(torque, 0); // it can be read again
        QVERIFY(guard.holding().empty());
    }
};

DYNASCOPE_UI_TEST(TestTorqueGuard)
#include "tst_torqueguard.moc"
