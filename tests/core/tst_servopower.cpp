// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// What lasts and what doesn't: EEPROM and RAM over reboots and losses of power, also in the middle of a write.
class TestServoPower : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_bench.start(); }

    void whatLasts_data()
    {
        QTest::addColumn<QString>("how");
        for (const char *how : {"Reboot", "power cut", "unplugged", "main switch", "powerCycle"})
            QTest::newRow(how) << how;
    }

    void whatLasts()
    {
        QFETCH(QString, how);
        m_bench.write(u"Return Delay Time", 20);
        m_bench.write(u"Max Position Limit", 3000);
        m_bench.write(u"LED", 1);
        m_bench.write(u"Position P Gain", 333);
        m_bench.write(u"Profile Velocity", 44);
        m_bench.ask(QStringLiteral("01 04 41 00 00"), QStringLiteral("01 00")); // Reg Write
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", 2500);
        m_bench.wait(8s);
        lose(how);
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 20);
        QCOMPARE(m_bench.value(u"Max Position Limit"), 3000);
        QCOMPARE(m_bench.value(u"ID"), 1);
        QCOMPARE(m_bench.value(u"Model Number"), 1020);
        QVERIFY(m_bench.value(u"Firmware Version") > 0);
        QCOMPARE(m_bench.value(u"LED"), 0);
        QCOMPARE(m_bench.value(u"Position P Gain"), 800);
        QCOMPARE(m_bench.value(u"Profile Velocity"), 0);
        QCOMPARE(m_bench.value(u"Torque Enable"), 0);
        QCOMPARE(m_bench.value(u"Registered Instruction"), 0);
        QCOMPARE(m_bench.value(u"Goal Position"), m_bench.value(u"Present Position"));
        QVERIFY(m_bench.value(u"Realtime Tick") < 300);
    }

    void aBackupOutlivesThePower()
    {
        m_bench.write(u"Return Delay Time", 20);
        m_bench.ask(QStringLiteral("01 20 01 43 54 52 4C"), QStringLiteral("01 00"));
        lose(QStringLiteral("power cut"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Backup Ready"), 1);
        m_bench.write(u"Return Delay Time", 30);
        m_bench.ask(QStringLiteral("01 20 02 43 54 52 4C"), QStringLiteral("01 00"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 20);
        lose(QStringLiteral("power cut")); // what was restored lasts
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 20);
    }

    /// The old value or the new one, never a mixture: by when the power goes.
    void aCutInTheMiddleOfAWrite_data()
    {
        QTest::addColumn<int>("microseconds"); // after the instruction's last bit
        QTest::addColumn<bool>("isNew");
        QTest::newRow("at once") << 1 << false;
        QTest::newRow("early") << 1000 << false;
        QTest::newRow("just before") << 1499 << false;
        QTest::newRow("just after") << 1500 << true;
        QTest::newRow("late") << 2900 << true;
        QTest::newRow("after the answer") << 10000 << true;
    }

    void aCutInTheMiddleOfAWrite()
    {
        QFETCH(int, microseconds);
        QFETCH(bool, isNew);
        m_bench.write(u"Homing Offset", 0x01020304 % 1000);
        m_bench.wait(20ms);
        const Bytes packet = m_bench.writePacket(u"Homing Offset", -1000000);
        send(packet);
        QCOMPARE(m_bench.value(u"Homing Offset"), -1000000); // who reads now reads it
        m_bench.wait(std::chrono::microseconds(microseconds));
        lose(QStringLiteral("power cut"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Homing Offset"), isNew ? -1000000 : 0x01020304 % 1000);
    }

    /// Several registers in one Write are stored one after the other.
    void severalRegistersOneByOne()
    {
        int mixed = 0;
        for (int microseconds = 50; microseconds < 3000; microseconds += 250) {
            m_bench.start();
            // PWM Limit 36, Current Limit 38: two registers side by side.
            send(oracle::instruction(1, 3, hex(QStringLiteral("24 00 64 00 C8 00"))));
            m_bench.wait(std::chrono::microseconds(microseconds));
            lose(QStringLiteral("power cut"));
            m_bench.wait(500ms);
            const auto pwm = m_bench.value(u"PWM Limit"), current = m_bench.value(u"Current Limit");
            QVERIFY(pwm == 885 || pwm == 100);
            QVERIFY(current == 1193 || current == 200);
            QVERIFY(current == 1193 || pwm == 100); // in order
            mixed += pwm == 100 && current == 1193;
        }
        QVERIFY(mixed > 2);
    }

    void theWritesTimeIsASetting()
    {
        m_bench.servo().settings().eepromWrite = 100ms;
        send(m_bench.writePacket(u"Return Delay Time", 20));
        m_bench.wait(40ms);
        lose(QStringLiteral("power cut"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 250);
    }

    void aRebootFinishesTheWrite()
    {
        send(m_bench.writePacket(u"Return Delay Time", 20));
        send(instruction(QStringLiteral("01 08")));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 20);
        lose(QStringLiteral("power cut"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"Return Delay Time"), 20);
    }

    void aCutInTheMiddleOfAReset()
    {
        m_bench.start(QStringLiteral("XM430-W350"), -1, 1000000, 5);
        m_bench.write(u"Return Delay Time", 20);
        m_bench.write(u"Shutdown", 1);
        m_bench.wait(10ms);
        send(instruction(QStringLiteral("05 06 FF")));
        m_bench.wait(1500us);
        lose(QStringLiteral("power cut"));
        m_bench.wait(500ms);
        QCOMPARE(m_bench.value(u"ID"), 1);                // early in the table: reset
        QCOMPARE(m_bench.value(u"Return Delay Time"), 250);
        QCOMPARE(m_bench.value(u"Shutdown"), 1);          // late: as it was
        QCOMPARE(m_bench.value(u"Model Number"), 1020);
    }

    void whoHasNoPowerSaysNothing()
    {
        m_bench.servo().setPower(false);
        QVERIFY(m_bench.client().exchange(QStringLiteral("01 01")).empty());
        // Nor finishes what it was about to say.
        m_bench.servo().setPower(true);
        m_bench.wait(500ms);
        send(instruction(QStringLiteral("01 01")));
        m_bench.servo().setPower(false);
        Bytes heard;
        m_bench.wait(20ms);
        m_bench.bus().receive(heard, m_bench.client().now, 57600);
        QVERIFY(heard.empty());
    }

    void aJointWithoutPowerFalls()
    {
        Joint &joint = m_bench.servo().joint();
        joint.setGravityArm(1);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(2s);
        const double held = joint.plant().angle();
        m_bench.wait(1s);
        QVERIFY(qAbs(joint.plant().angle() - held) < 0.01);
        m_bench.servo().setPlugged(false);
        m_bench.wait(2s);
        QVERIFY(joint.plant().angle() > held + 0.5);
        QCOMPARE(joint.supplyCurrent(), 0.0);
        m_bench.servo().setPlugged(true);
        m_bench.wait(1s);
        m_bench.ask(QStringLiteral("01 02 40 00 01 00"), QStringLiteral("01 00 00")); // torque by nobody's order
    }

    void powerComesOnlyWithAllOfIt()
    {
        Servo &servo = m_bench.servo();
        servo.setPlugged(false);
        m_bench.power().setOn(false);
        servo.setPlugged(true);
        QVERIFY(!servo.isPowered());
        servo.setPower(false);
        m_bench.power().setOn(true);
        m_bench.wait(50ms);
        QVERIFY(!servo.isPowered());
        servo.setPower(true);
        QVERIFY(servo.isPowered());
    }

    void startupTurnsTorqueOnWhenItHasBooted()
    {
        m_bench.write(u"Startup Configuration", 1);
        lose(QStringLiteral("power cut"));
        m_bench.wait(300ms);
        QVERIFY(!m_bench.servo().joint().torque());
        m_bench.wait(150ms);
        QVERIFY(m_bench.servo().joint().torque());
        QCOMPARE(m_bench.value(u"Torque Enable"), 1);
    }

    void theOtherAxisLocksTheEeprom()
    {
        m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, 2);
        m_bench.servo(0).setOtherAxis(&m_bench.servo(1));
        m_bench.servo(1).setOtherAxis(&m_bench.servo(0));
        m_bench.write(u"Torque Enable", 1, 1);
        QCOMPARE(m_bench.tryWrite(u"Return Delay Time", 20, 0), 7);
        QCOMPARE(m_bench.tryWrite(u"LED", 1, 0), 0);
        m_bench.write(u"Torque Enable", 0, 1);
        QCOMPARE(m_bench.tryWrite(u"Return Delay Time", 20, 0), 0);
    }

private:
    void send(const Bytes &packet)
    {
        Client &client = m_bench.client();
        client.bus.send(packet, client.now, client.baudRate);
        client.now += static_cast<LineTime::rep>(packet.size()) * LineTime(10'000'000'000LL / client.baudRate);
        m_bench.bus().advanceTo(client.now);
    }
    void lose(const QString &how)
    {
        Servo &servo = m_bench.servo();
        if (how == u"Reboot") {
            m_bench.client().exchange(QStringLiteral("01 08"));
        } else if (how == u"powerCycle") {
            servo.powerCycle();
        } else if (how == u"main switch") {
            m_bench.power().setOn(false);
            m_bench.wait(20ms);
            m_bench.power().setOn(true);
        } else {
            const bool cable = how == u"unplugged";
            cable ? servo.setPlugged(false) : servo.setPower(false);
            QVERIFY(!servo.isPowered());
            m_bench.wait(20ms);
            cable ? servo.setPlugged(true) : servo.setPower(true);
        }
    }

    const Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestServoPower)
#include "tst_servopower.moc"
