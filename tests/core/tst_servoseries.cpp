// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/truth.h"
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// Models of other series, whose tables name and scale things otherwise: played without a line of code for them.
class TestServoSeries : public QObject
{
    Q_OBJECT

private slots:
    void movesToItsGoal_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("start");
        QTest::addColumn<int>("goal");
        QTest::newRow("P") << "PH54-200-S500-R" << 0 << 250000;
        QTest::newRow("P, back") << "PH54-200-S500-R" << 0 << -250000;
        QTest::newRow("PRO") << "H42-20-S300-R" << 0 << 70000;
        QTest::newRow("XL-320") << "XL-320" << 621 << 900;
        QTest::newRow("Y") << "YM070-210-R051-RH" << 0 << -100000;
        QTest::newRow("X") << "XM430-W350" << 2048 << 3000;
    }

    /// Stands where its series begins, goes where it shall, stays there, and finds nothing wrong with its supply.
    void movesToItsGoal()
    {
        QFETCH(QString, model);
        QFETCH(int, start);
        QFETCH(int, goal);
        m_bench.start(model);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Present Position"), start);
        QVERIFY(!m_bench.servo().hasAlert());
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", goal);
        const double turn = m_bench.servo().table().resolution();
        double farthest = 0, reached = 0;
        for (int i = 0; i < 500; ++i) {
            m_bench.wait(10ms);
            const double way = static_cast<double>(m_bench.value(u"Present Position") - start) / (goal - start);
            farthest = std::max(farthest, way);
            reached = way;
        }
        QVERIFY2(farthest < 1.25, qPrintable(QString::number(farthest)));
        QVERIFY2(qAbs(reached - 1) * qAbs(goal - start) < turn / 100, qPrintable(QString::number(reached)));
        QVERIFY(!m_bench.servo().hasAlert());
        QVERIFY(m_bench.servo().joint().isResting());
    }

    void turnsAtItsGoalVelocity_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("mode");
        QTest::addColumn<int>("velocityMode");
        QTest::addColumn<QString>("goal");
        QTest::addColumn<int>("raw");
        QTest::addColumn<double>("speed"); // rev/min of the shaft
        QTest::newRow("P") << "PH54-200-S500-R" << "Operating Mode" << 1 << "Goal Velocity" << 1500 << 15.0;
        QTest::newRow("PRO") << "H42-20-S300-R" << "Operating Mode" << 1 << "Goal Velocity" << -5000 << -16.461;
        QTest::newRow("Y") << "YM070-210-R051-RH" << "Operating Mode" << 1 << "Goal Velocity" << 2000 << 20.0;
        QTest::newRow("XL-320, wheel") << "XL-320" << "Control Mode" << 1 << "Moving Speed" << 500 << 55.5;
        QTest::newRow("XL-320, wheel back") << "XL-320" << "Control Mode" << 1 << "Moving Speed" << 1024 + 500 << -55.5;
    }

    void turnsAtItsGoalVelocity()
    {
        QFETCH(QString, model);
        QFETCH(QString, mode);
        QFETCH(int, velocityMode);
        QFETCH(QString, goal);
        QFETCH(int, raw);
        QFETCH(double, speed);
        m_bench.start(model);
        m_bench.write(mode, velocityMode);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(goal, raw);
        m_bench.wait(5s);
        const double found = m_bench.servo().joint().plant().speed() * 9.5493;
        QVERIFY2(qAbs(found - speed) < 0.03 * qAbs(speed), qPrintable(QString::number(found)));
        const bool isXl320 = goal == u"Moving Speed";
        const auto present = m_bench.value(isXl320 ? u"Present Speed" : u"Present Velocity");
        QVERIFY(qAbs(present - raw) < 0.03 * qAbs(raw) + 2);
        if (isXl320) // after some turns
            QVERIFY2(m_bench.value(u"Present Position") < 1300, "its position counts within one turn");
        QVERIFY(!m_bench.servo().hasAlert());
    }

    /// Without Profile Velocity the goal's velocity is that of the way.
    void theWayHasTheGoalsVelocity()
    {
        m_bench.start(QStringLiteral("XL-320"));
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Moving Speed", 90); // 10 rev/min
        m_bench.write(u"Goal Position", 615 + 205); // a sixth of a turn: 1 s
        m_bench.wait(500ms);
        const auto half = m_bench.value(u"Present Position") - 615;
        QVERIFY2(half > 80 && half < 125, qPrintable(QString::number(half)));
    }

    void currentIsLimitedWhereNoStallIsStated()
    {
        m_bench.start(QStringLiteral("PH54-200-S500-R"));
        m_bench.write(u"Current Limit", 5000);
        m_bench.servo().joint().setStops(-30, 30);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", 250000);
        for (int i = 0; i < 200; ++i) { // the stop makes it more for a moment
            m_bench.wait(5ms);
            const auto current = m_bench.value(u"Present Current");
            QVERIFY2(qAbs(current) < (i < 40 ? 5100 : 8000), qPrintable(QString::number(current)));
        }
        m_bench.wait(1s);
        QVERIFY(m_bench.servo().joint().plant().angle() > 0.52); // at the stop
        QVERIFY(qAbs(m_bench.value(u"Present Current") - 5000) < 250);
    }

    void faultsByTheTablesBits()
    {
        m_bench.start(QStringLiteral("XL-320"));
        QVERIFY(m_bench.servo().inject(HardwareFault::InputVoltage));
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 4);
        QVERIFY(!m_bench.servo().isShutDown());
        QVERIFY(m_bench.servo().inject(HardwareFault::Overload));
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 5);
        QVERIFY(m_bench.servo().isShutDown());
        m_bench.start(QStringLiteral("PH54-200-S500-R"));
        QVERIFY(m_bench.servo().inject(HardwareFault::HallSensor));
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 2);
        QVERIFY(m_bench.servo().isShutDown());
        m_bench.start(QStringLiteral("PH54-200-S500-R"));
        m_bench.write(u"LED Red", 200);
        QCOMPARE(truth(m_bench.servo()).value(u"led").toString(), QStringLiteral("on"));
    }

    /// The Y series has numbers of errors, and Clear takes them away.
    void yHasErrorCodesAndClearsThem()
    {
        m_bench.start(QStringLiteral("YM070-210-R051-RH"));
        m_bench.write(u"Torque Enable", 1);
        QVERIFY(m_bench.servo().inject(HardwareFault::Overload));
        QCOMPARE(m_bench.value(u"Error Code"), 5);
        QCOMPARE(m_bench.value(u"Torque Enable"), 0);
        QCOMPARE(m_bench.tryWrite(u"Goal Velocity", 0), 0x80);
        m_bench.ask(QStringLiteral("01 10 02 45 52 43 4C"), QStringLiteral("01 00"));
        QCOMPARE(m_bench.value(u"Error Code"), 0);
        QCOMPARE(m_bench.tryWrite(u"Torque Enable", 1), 0);
        QCOMPARE(m_bench.value(u"Torque Enable"), 1);
    }

    void yStoresHybridRegistersOnRequest()
    {
        m_bench.start(QStringLiteral("YM070-210-R051-RH"));
        m_bench.write(u"Profile Velocity", 1000);
        m_bench.client().exchange(QStringLiteral("01 08"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Profile Velocity"), 3921); // was in RAM alone
        m_bench.write(u"Profile Velocity", 1000);
        m_bench.write(u"Hybrid Save", 1);
        QCOMPARE(m_bench.value(u"Hybrid Save"), 2);
        m_bench.write(u"Profile Velocity", 2000);
        m_bench.servo().powerCycle();
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Profile Velocity"), 1000);
        m_bench.client().exchange(QStringLiteral("01 06 02"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Profile Velocity"), 3921);
    }

    void yTimesItsProfileByOtherRegisters()
    {
        m_bench.start(QStringLiteral("YM070-210-R051-RH"));
        m_bench.write(u"Drive Mode", 4);
        m_bench.write(u"Profile Time", 5000); // 1 s
        m_bench.write(u"Profile Acceleration Time", 1000);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", 50000);
        m_bench.wait(900ms);
        QVERIFY(m_bench.value(u"Moving Status") & 2);
        m_bench.wait(100ms);
        QVERIFY(!(m_bench.value(u"Moving Status") & 2));
        QCOMPARE(m_bench.value(u"Moving Status") >> 4 & 3, 3);
    }

    void firmwareAbilities_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answer");
        const QString clear = QStringLiteral("01 10 01 44 58 4C 22"), backup = QStringLiteral("01 20 01 43 54 52 4C");
        QTest::newRow("X clears from 42") << "XM430-W350" << 42 << clear << "01 00";
        QTest::newRow("not before") << "XM430-W350" << 41 << clear << "01 02";
        QTest::newRow("P clears, by its own count") << "PH54-200-S500-R" << 12 << clear << "01 00";
        QTest::newRow("PRO doesn't") << "H42-20-S300-R" << 45 << clear << "01 02";
        QTest::newRow("XL-320 doesn't") << "XL-320" << 45 << clear << "01 02";
        QTest::newRow("P has no error to clear") << "PH54-200-S500-R" << 12 << "01 10 02 45 52 43 4C" << "01 04";
        QTest::newRow("X backs up from 45") << "XM430-W350" << 45 << backup << "01 00";
        QTest::newRow("X not before") << "XM430-W350" << 44 << backup << "01 02";
        QTest::newRow("X330 from 46") << "XL330-M288" << 46 << backup << "01 00";
        QTest::newRow("X330 not before") << "XL330-M288" << 45 << backup << "01 02";
        QTest::newRow("bit 3 of Drive Mode from 45") << "XM430-W350" << 45 << "01 03 0A 00 08" << "01 00";
        QTest::newRow("bit 3 not before") << "XM430-W350" << 44 << "01 03 0A 00 08" << "01 04";
        QTest::newRow("bit 2 from 42") << "XM430-W350" << 42 << "01 03 0A 00 04" << "01 00";
        QTest::newRow("bit 2 not before") << "XM430-W350" << 41 << "01 03 0A 00 04" << "01 04";
        QTest::newRow("no Drive Mode before 38") << "XM430-W350" << 37 << "01 03 0A 00 01" << "01 07";
    }

    void firmwareAbilities()
    {
        QFETCH(QString, model);
        QFETCH(int, firmware);
        QFETCH(QString, request);
        QFETCH(QString, answer);
        m_bench.start(model, firmware);
        m_bench.ask(request, answer);
    }

    void fastReadsByFirmware_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<bool>("answered"); // otherwise silence
        QTest::newRow("X430 from 45") << "XM430-W350" << 45 << true;
        QTest::newRow("X430 before") << "XM430-W350" << 44 << false;
        QTest::newRow("X330 from 46") << "XL330-M288" << 46 << true;
        QTest::newRow("X330 before") << "XL330-M288" << 45 << false;
        QTest::newRow("a table that states none") << "H42-20-S300-R" << 45 << false;
    }

    void fastReadsByFirmware()
    {
        QFETCH(QString, model);
        QFETCH(int, firmware);
        QFETCH(bool, answered);
        m_bench.start(model, firmware);
        for (const char *request : {"FE 8A 07 00 01 00 01", "FE 9A 01 07 00 01 00"})
            QCOMPARE(!m_bench.client().exchange(QString::fromLatin1(request)).empty(), answered);
    }

    /// Whatever the catalog knows boots, holds a position and survives every value of every register.
    void everyModelOfTheCatalog()
    {
        for (const Catalog::ModelInfo &info : m_catalog.models()) {
            if (info.addressesOnly)
                continue;
            const int axes = m_catalog.find(info.modelNumber, info.newestFirmware)->axes();
            m_bench.start(info.model, -1, 57600, 1, axes == 2 ? 2 : -1);
            m_bench.servo().write(u"Torque Enable", 1);
            m_bench.wait(500ms);
            QVERIFY2(!m_bench.servo().hasAlert(), qPrintable(info.model));
            for (const std::int64_t raw : {0, 1, -1, 255, 32767, 0x7FFFFFFF}) {
                for (const Field &field : m_bench.servo().table().fields()) {
                    if (field.name != u"ID" && field.name != u"Baud Rate" && field.name != u"Protocol Type")
                        m_bench.servo().write(field.name, raw);
                }
                m_bench.wait(200ms);
            }
            QVERIFY2(m_bench.servo().id() == 1, qPrintable(info.model));
        }
    }

private:
    Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestServoSeries)
#include "tst_servoseries.moc"
