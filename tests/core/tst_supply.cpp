// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The supply that the servos of a bus share: it sags with the current of all of them.
class TestSupply : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_bench.start(); }

    void sagsWithTheCurrentOfAll_data()
    {
        QTest::addColumn<double>("ohms");
        QTest::addColumn<int>("stalled");
        for (const double ohms : {0.0, 0.1, 0.5}) {
            for (const int stalled : {0, 1, 3})
                QTest::addRow("%g Ohm, %d stalled", ohms, stalled) << ohms << stalled;
        }
    }

    void sagsWithTheCurrentOfAll()
    {
        QFETCH(double, ohms);
        QFETCH(int, stalled);
        for (const int id : {2, 3})
            m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, id);
        m_bench.power().setResistance(ohms);
        const MotorModel &motor = m_bench.servo().joint().plant().motor();
        for (int i = 0; i < stalled; ++i)
            stall(i);
        m_bench.wait(300ms);
        // Each stalled motor is its winding's resistance; all draw the current of their electronics.
        const double expected =
            (12 - ohms * 3 * motor.standbyCurrent) / (1 + ohms * stalled / motor.resistance());
        for (int i = 0; i < 3; ++i) {
            QVERIFY2(qAbs(m_bench.servo(i).joint().volts() - expected) < 1e-3,
                     qPrintable(QStringLiteral("%1 for %2").arg(m_bench.servo(i).joint().volts()).arg(expected)));
            QCOMPARE(m_bench.value(u"Present Input Voltage", i), qRound(expected * 10));
        }
    }

    void oneThatStallsSlowsTheOther()
    {
        m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, 2);
        m_bench.power().setResistance(1);
        m_bench.write(u"Operating Mode", 16, 1);
        m_bench.write(u"Torque Enable", 1, 1);
        m_bench.wait(1s);
        const double alone = m_bench.servo(1).joint().plant().speed();
        stall(0);
        m_bench.wait(500ms);
        QVERIFY(m_bench.servo(1).joint().plant().speed() < 0.9 * alone);
    }

    void brakingRaisesTheVoltage()
    {
        m_bench.power().setResistance(1);
        m_bench.write(u"Operating Mode", 16);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(1s);
        m_bench.write(u"Goal PWM", 300);
        m_bench.client().now += 0ms;
        double highest = 0;
        for (int i = 0; i < 30; ++i) {
            m_bench.wait(1ms);
            highest = std::max(highest, m_bench.servo().joint().volts());
        }
        m_bench.servo().joint().push(6, 1); // faster than it would turn
        for (int i = 0; i < 500; ++i) {
            m_bench.wait(1ms);
            highest = std::max(highest, m_bench.servo().joint().volts());
        }
        QVERIFY(highest > 12);
    }

    void aRestingHoldFeelsTheVoltage()
    {
        Joint &joint = m_bench.servo().joint();
        joint.setGravityArm(1);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(5s);
        QVERIFY(joint.isResting());
        const double before = joint.plant().current();
        QVERIFY(qAbs(before) > 0.1);
        m_bench.power().setVoltage(10);
        m_bench.wait(20ms);
        QVERIFY(qAbs(m_bench.servo().joint().volts() - 9.95) < 0.05);
        QVERIFY(qAbs(joint.plant().current()) < qAbs(before) * 0.95); // the same PWM of less
    }

    void smallServosHaveTheirOwn()
    {
        m_bench.add(QStringLiteral("XL430-W250"), -1, 57600, 2); // 6 to 14 V: takes the 12 V
        m_bench.add(QStringLiteral("XL330-M288"), -1, 57600, 3);
        QCOMPARE(int(m_bench.power().supplies().size()), 2);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Present Input Voltage", 0), 120);
        QCOMPARE(m_bench.value(u"Present Input Voltage", 1), 120);
        QCOMPARE(m_bench.value(u"Present Input Voltage", 2), 50);
        for (int i = 0; i < 3; ++i)
            QCOMPARE(m_bench.value(u"Hardware Error Status", i), 0);
        m_bench.power().setVoltage(11.1); // one for all: too much for the small one
        m_bench.wait(100ms);
        QCOMPARE(int(m_bench.power().supplies().size()), 1);
        QCOMPARE(m_bench.value(u"Present Input Voltage", 2), 111);
        QCOMPARE(m_bench.value(u"Hardware Error Status", 1), 0);
        QCOMPARE(m_bench.value(u"Hardware Error Status", 2), 1);
        QVERIFY(m_bench.servo(2).isShutDown());
    }

    void moreServosJoinTheCommonSupply()
    {
        m_bench.power().setVoltage(14);
        m_bench.add(QStringLiteral("XL430-W250"), -1, 57600, 2);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Present Input Voltage", 1), 140);
    }

    /// Who is asked, and how often, changes nothing.
    void togetherWhoeverIsAsked()
    {
        std::vector<double> ends;
        for (const int way : {0, 1, 2}) {
            m_bench.start();
            m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, 2);
            m_bench.power().setResistance(0.5);
            for (int i = 0; i < 2; ++i) {
                m_bench.servo(i).write(u"Torque Enable", 1);
                m_bench.servo(i).write(u"Goal Position", 3000);
            }
            const LineTime from = m_bench.client().now;
            for (LineTime t = 0ms; t <= 400ms; t += way == 0 ? 400ms : 7100us) {
                if (way == 1)
                    m_bench.servo(1).advanceTo(from + t);
                if (way == 2)
                    m_bench.bus().advanceTo(from + t);
            }
            m_bench.bus().advanceTo(from + 400ms);
            for (int i = 0; i < 2; ++i)
                ends.push_back(m_bench.servo(i).joint().plant().angle());
        }
        QVERIFY(ends[0] > 3.5);
        for (std::size_t i = 0; i < ends.size(); ++i)
            QCOMPARE(ends[i], ends[0]);
    }

    /// Idle servos, torque on or off, cost nothing: none of their steps is reckoned.
    void idleServosRest()
    {
        for (int id = 2; id <= 6; ++id)
            m_bench.add(id % 2 ? QStringLiteral("XL330-M288") : QStringLiteral("XL430-W250"), -1, 57600, id);
        for (int i = 0; i < 6; ++i) {
            m_bench.servo(i).joint().setGravityArm(0.05);
            if (i < 4)
                m_bench.write(u"Torque Enable", 1, i);
        }
        m_bench.wait(5s);
        for (int t = 0; t < 20; ++t) {
            m_bench.wait(500ms);
            for (int i = 0; i < 6; ++i)
                QVERIFY2(m_bench.servo(i).joint().isResting(), qPrintable(QString::number(i)));
        }
    }

    void theMainSwitch()
    {
        m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, 2);
        for (int i = 0; i < 2; ++i)
            m_bench.write(u"LED", 1, i);
        m_bench.power().setOn(false);
        m_bench.wait(50ms);
        QVERIFY(!m_bench.servo(0).isPowered() && !m_bench.servo(1).isPowered());
        QCOMPARE(m_bench.servo(0).joint().volts(), 0.0);
        QVERIFY(m_bench.client().exchange(QStringLiteral("FE 01"), 1s).empty());
        m_bench.power().setOn(true);
        m_bench.wait(399ms);
        QVERIFY(m_bench.client().exchange(QStringLiteral("01 01"), 500us).empty()); // still booting
        m_bench.wait(10ms);
        m_bench.ask(QStringLiteral("01 01"), QStringLiteral("01 00 FC 03 2D"));
        QCOMPARE(m_bench.value(u"LED", 0), 0);
        QCOMPARE(m_bench.value(u"LED", 1), 0);
    }

    void tooLittleIsABrownOut()
    {
        m_bench.write(u"LED", 1);
        m_bench.power().setVoltage(7); // an error, but it runs: XM430's factory limit is 9.5 V
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"LED"), 1);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 1);
        m_bench.power().setVoltage(5);
        m_bench.wait(100ms);
        QVERIFY(!m_bench.servo().isPowered());
        m_bench.power().setVoltage(12);
        m_bench.wait(500ms);
        QVERIFY(m_bench.servo().isPowered());
        QCOMPARE(m_bench.value(u"LED"), 0);
        QCOMPARE(m_bench.value(u"Hardware Error Status"), 0);
        QVERIFY(m_bench.value(u"Realtime Tick") < 200);
    }

    void wildNumbersAreTamed()
    {
        for (const double wild : {-1.0, 0.0, 1e300, std::nan(""), HUGE_VAL}) {
            m_bench.power().setVoltage(wild);
            m_bench.power().setResistance(wild);
            stall(0);
            m_bench.wait(100ms);
            QVERIFY(std::isfinite(m_bench.servo().joint().volts()));
            QVERIFY(m_bench.servo().joint().volts() >= 0);
        }
    }

private:
    /// Full PWM against something that doesn't give way.
    void stall(int index)
    {
        Servo &servo = m_bench.servo(index);
        servo.joint().setExtraInertia(1000);
        servo.write(u"Operating Mode", 16);
        servo.write(u"Torque Enable", 1);
        servo.write(u"Goal PWM", 885);
    }

    const Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestSupply)
#include "tst_supply.moc"
