// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/servobench.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// Single registers and what they do, and refusals by number, where tst_servo and tst_servobehaviour don't.
class TestServoRegisters : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_bench.start(); }

    void refusals_data()
    {
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answer");
        const QString torque = QStringLiteral("01 03 40 00 01");
        QTest::newRow("begins inside a register") << "" << "01 03 75 00 00 00 00" << "01 05";
        QTest::newRow("begins inside, ends inside") << "" << "01 03 75 00 00" << "01 05";
        QTest::newRow("begins inside and runs into a read-only one") << "" << "01 03 75 00 00 00 00 00" << "01 07";
        QTest::newRow("ends inside the second") << "" << "01 03 70 00 00 00 00 00 00 00" << "01 05";
        QTest::newRow("no data") << "" << "01 03 41 00" << "01 05";
        QTest::newRow("a value no name stands for") << "" << "01 03 0D 00 00" << "01 04";
        QTest::newRow("Goal PWM beyond PWM Limit") << "01 03 24 00 64 00" << "01 03 64 00 65 00" << "01 06";
        QTest::newRow("and below it") << "01 03 24 00 64 00" << "01 03 64 00 9B FF" << "01 06";
        QTest::newRow("at it") << "01 03 24 00 64 00" << "01 03 64 00 9C FF" << "01 00";
        QTest::newRow("Goal Current beyond Current Limit") << "01 03 26 00 64 00" << "01 03 66 00 65 00" << "01 06";
        QTest::newRow("Goal Velocity beyond Velocity Limit") << "" << "01 03 68 00 C9 00 00 00" << "01 06";
        QTest::newRow("Goal Velocity at it, back") << "" << "01 03 68 00 38 FF FF FF" << "01 00";
        QTest::newRow("Goal Position below Min Position Limit") << "01 03 34 00 00 04 00 00"
                                                                << "01 03 74 00 FF 03 00 00" << "01 06";
        QTest::newRow("no position limits in Extended Position mode") << "01 03 0B 00 04"
                                                                      << "01 03 74 00 00 00 0F 00" << "01 00";
        QTest::newRow("but its own range") << "01 03 0B 00 04" << "01 03 74 00 00 00 10 00" << "01 04";
        QTest::newRow("Profile Velocity, time-based: another range") << "01 03 0A 00 04"
                                                                     << "01 03 70 00 FF 7F 00 00" << "01 04";
        QTest::newRow("Profile Velocity, velocity-based") << "" << "01 03 70 00 FF 7F 00 00" << "01 00";
        QTest::newRow("EEPROM by Indirect Data isn't possible") << "" << "01 03 A8 00 3F 00" << "01 04";
        QTest::newRow("half a register by Indirect Data") << "01 03 A8 00 74 00" << "01 03 E0 00 00" << "01 05";
        QTest::newRow("a whole one by four") << "01 03 A8 00 74 00 75 00 76 00 77 00" << "01 03 E0 00 00 08 00 00"
                                             << "01 00";
        QTest::newRow("four, with its range") << "01 03 A8 00 74 00 75 00 76 00 77 00" << "01 03 E0 00 00 10 00 00"
                                              << "01 06";
        QTest::newRow("Reg Write into locked EEPROM") << torque << "01 04 09 00 0A" << "01 07";
        QTest::newRow("Action into EEPROM that is locked by now") << QStringLiteral("01 04 09 00 0A;") + torque << "01 05" << "01 07";
        QTest::newRow("Factory Reset by Secondary ID") << "01 03 0C 00 07;01 03 09 00 0A;07 06 02"
                                                       << "01 02 09 00 01 00" << "01 00 0A";
        QTest::newRow("Reg Write and Action by Secondary ID") << "01 03 0C 00 07;07 04 41 00 01;07 05"
                                                              << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Sync Write by Secondary ID") << "01 03 0C 00 07;FE 83 41 00 01 00 07 01"
                                                    << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Restore by Secondary ID") << "01 03 0C 00 07;01 20 01 43 54 52 4C;01 03 09 00 0A;"
                                                    "07 20 02 43 54 52 4C"
                                                 << "01 02 09 00 01 00" << "01 00 0A";
        QTest::newRow("two Reg Writes: the last counts") << "01 04 41 00 01;01 04 41 00 00;01 05"
                                                         << "01 02 41 00 01 00" << "01 00 00";
    }

    void refusals()
    {
        QFETCH(QString, before);
        QFETCH(QString, request);
        QFETCH(QString, answer);
        m_bench.client().exchangeAll(before);
        m_bench.ask(request, answer);
    }

    /// Each instruction at each Status Return Level, to the servo and to everybody: is there an answer?
    void whoAnswers_data()
    {
        QTest::addColumn<QString>("parameters"); // behind the ID
        QTest::addColumn<int>("least");          // level; 3: never
        QTest::addColumn<bool>("broadcast");     // answered as well
        QTest::newRow("Ping") << "01" << 0 << true;
        QTest::newRow("Read") << "02 41 00 01 00" << 1 << false;
        QTest::newRow("Write") << "03 41 00 01" << 2 << false;
        QTest::newRow("Write, refused") << "03 41 00 07" << 2 << false;
        QTest::newRow("Reg Write") << "04 41 00 01" << 2 << false;
        QTest::newRow("Action") << "05" << 2 << false;
        QTest::newRow("Factory Reset") << "06 02" << 2 << false;
        QTest::newRow("Reboot") << "08" << 2 << false;
        QTest::newRow("Clear") << "10 01 44 58 4C 22" << 2 << false;
        QTest::newRow("Backup") << "20 01 43 54 52 4C" << 2 << false;
        QTest::newRow("unknown") << "77" << 2 << false;
        QTest::newRow("Sync Read") << "82 41 00 01 00 01" << 1 << true;
        QTest::newRow("Sync Write") << "83 41 00 01 00 01 01" << 3 << false;
        QTest::newRow("Fast Sync Read") << "8A 41 00 01 00 01" << 1 << true;
        QTest::newRow("Bulk Read") << "92 01 41 00 01 00" << 1 << true;
        QTest::newRow("Bulk Write") << "93 01 41 00 01 00 01" << 3 << false;
        QTest::newRow("Fast Bulk Read") << "9A 01 41 00 01 00" << 1 << true;
    }

    void whoAnswers()
    {
        QFETCH(QString, parameters);
        QFETCH(int, least);
        QFETCH(bool, broadcast);
        const bool group = parameters.startsWith(u'8') || parameters.startsWith(u'9');
        for (const int level : {0, 1, 2}) {
            for (const bool toAll : {false, true}) {
                m_bench.start();
                m_bench.client().exchange(m_bench.writePacket(u"Status Return Level", level));
                const QString id = toAll ? QStringLiteral("FE ") : QStringLiteral("01 ");
                const Bytes heard = m_bench.client().exchange(id + parameters);
                const bool expected = level >= least && (toAll ? broadcast : !group);
                QVERIFY2(heard.empty() != expected, qPrintable(QStringLiteral("level %1").arg(level)));
            }
        }
    }

    void returnDelayTime_data()
    {
        QTest::addColumn<int>("raw");
        QTest::addColumn<int>("microseconds");
        QTest::newRow("0") << 0 << 0;
        QTest::newRow("1") << 1 << 2;
        QTest::newRow("factory") << 250 << 500;
        QTest::newRow("most") << 254 << 508;
    }

    void returnDelayTime()
    {
        QFETCH(int, raw);
        QFETCH(int, microseconds);
        m_bench.servo().write(u"Return Delay Time", raw);
        m_bench.client().exchange(QStringLiteral("01 01"));
        const LineTime byte(10'000'000'000LL / 57600);
        QCOMPARE(m_bench.client().firstByte,
                 byte + m_bench.servo().settings().processing + std::chrono::microseconds(microseconds));
    }

    /// In fast reads it is paid once, by the first listed.
    void returnDelayInFastReads()
    {
        m_bench.add(QStringLiteral("XM430-W350"), -1, 57600, 2);
        m_bench.client().exchange(QStringLiteral("FE 8A 41 00 01 00 01 02"));
        const LineTime byte(10'000'000'000LL / 57600);
        QCOMPARE(m_bench.client().firstByte, byte + 600us);
        m_bench.servo(1).settings().fastGap = 50us;
        const Bytes heard = m_bench.client().exchange(QStringLiteral("FE 8A 41 00 01 00 01 02"));
        QCOMPARE(int(heard.size()), 18);
    }

    void anUnchangedModeKeepsWhatItHas()
    {
        m_bench.write(u"Position P Gain", 111);
        m_bench.write(u"Operating Mode", 3);
        QCOMPARE(m_bench.value(u"Position P Gain"), 111);
        m_bench.write(u"Operating Mode", 5);
        QCOMPARE(m_bench.value(u"Position P Gain"), 800);
    }

    void profileUnitsByDriveMode()
    {
        m_bench.write(u"Operating Mode", 4);
        m_bench.servo().joint().setShaftAngle(720 + 90);
        m_bench.write(u"Drive Mode", 4);
        QCOMPARE(m_bench.value(u"Present Position"), 2 * 4096 + 1024); // turns aren't forgotten for that
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Profile Acceleration", 200);
        m_bench.write(u"Profile Velocity", 1000); // 1 s
        m_bench.write(u"Goal Position", 2 * 4096 + 2048);
        m_bench.wait(900ms);
        QVERIFY(m_bench.value(u"Moving Status") & 2);
        QCOMPARE(m_bench.value(u"Moving Status") >> 4, 3);
        m_bench.wait(80ms);
        QVERIFY(!(m_bench.value(u"Moving Status") & 2));
        QVERIFY(qAbs(m_bench.value(u"Position Trajectory") - (2 * 4096 + 2048)) <= 1);
    }

    void profileVelocityObeysVelocityLimit()
    {
        m_bench.write(u"Velocity Limit", 50);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Profile Velocity", 400);
        m_bench.write(u"Goal Position", 4000);
        m_bench.wait(200ms);
        QCOMPARE(m_bench.value(u"Velocity Trajectory"), 50);
        m_bench.servo().settings().control.profileObeysVelocityLimit = false;
        m_bench.write(u"Goal Position", 1000);
        m_bench.wait(20ms);
        QCOMPARE(m_bench.value(u"Velocity Trajectory"), -400);
    }

    void accelerationWithoutVelocity()
    {
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Profile Acceleration", 5);
        m_bench.write(u"Goal Position", 4000);
        QCOMPARE(m_bench.value(u"Moving Status") >> 4, 2); // a triangle
        m_bench.servo().settings().control.profileNeedsVelocity = true;
        m_bench.write(u"Goal Position", 1000);
        QCOMPARE(m_bench.value(u"Moving Status") >> 4, 0);
    }

    void movingThreshold()
    {
        m_bench.write(u"Moving Threshold", 60);
        m_bench.write(u"Operating Mode", 1);
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Velocity", 50);
        m_bench.wait(3s);
        QCOMPARE(m_bench.value(u"Moving"), 0);
        m_bench.write(u"Goal Velocity", 80);
        m_bench.wait(3s);
        QCOMPARE(m_bench.value(u"Moving"), 1);
    }

    void inPositionIsASetting()
    {
        m_bench.servo().joint().setGravityArm(1); // sags some 40 pulses
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(2s);
        const auto away = qAbs(m_bench.value(u"Present Position") - m_bench.value(u"Goal Position"));
        QVERIFY(away > 20);
        QVERIFY(!(m_bench.value(u"Moving Status") & 1));
        m_bench.servo().settings().control.inPosition = static_cast<double>(away + 1) * 360 / 4096;
        QVERIFY(m_bench.value(u"Moving Status") & 1);
        m_bench.servo().settings().control.following = static_cast<double>(away - 1) * 360 / 4096;
        QVERIFY(m_bench.value(u"Moving Status") & 8);
    }

    /// XL330's PWM Slope: 140 × 1.977 mV/ms.
    void pwmSlope()
    {
        m_bench.start(QStringLiteral("XL330-M288"));
        for (const int raw : {140, 10}) {
            m_bench.servo().write(u"Torque Enable", 0);
            m_bench.servo().write(u"Operating Mode", 16);
            m_bench.servo().write(u"PWM Slope", raw);
            m_bench.servo().write(u"Goal PWM", 885);
            m_bench.wait(1s);
            m_bench.servo().write(u"Torque Enable", 1);
            m_bench.wait(10ms);
            const double expected = raw * 1.977 / 1000 * 10 / 5 * 885;
            QVERIFY(qAbs(m_bench.value(u"Present PWM") - expected) < expected * 0.12 + 2);
            m_bench.wait(2s);
            QCOMPARE(m_bench.value(u"Present PWM"), 885);
        }
    }

    void watchdogRefusesGoalsAndAllBut0()
    {
        m_bench.write(u"Bus Watchdog", 1);
        m_bench.write(u"Torque Enable", 1);
        m_bench.wait(100ms);
        QCOMPARE(m_bench.value(u"Bus Watchdog"), -1);
        for (const QStringView goal : {u"Goal PWM", u"Goal Current", u"Goal Velocity", u"Goal Position"})
            QCOMPARE(m_bench.tryWrite(goal, 0), 4);
        QCOMPARE(m_bench.tryWrite(u"Bus Watchdog", 10), 4);
        QCOMPARE(m_bench.tryWrite(u"LED", 1), 0);
        QCOMPARE(m_bench.tryWrite(u"Bus Watchdog", 0), 0);
        for (const QStringView goal : {u"Goal PWM", u"Goal Current", u"Goal Velocity", u"Goal Position"})
            QCOMPARE(m_bench.tryWrite(goal, 0), 0);
    }

    void watchdogsTimeDoesntDependOnWhoAsks()
    {
        for (const LineTime step : {1ms, 7ms, 200ms}) {
            m_bench.start();
            m_bench.servo().write(u"Torque Enable", 1);
            m_bench.servo().write(u"Bus Watchdog", 4); // 80 ms
            m_bench.client().exchange(QStringLiteral("09 01"), 0ms);
            const LineTime from = m_bench.client().now;
            for (LineTime t = step; t <= 80ms; t += step)
                m_bench.bus().advanceTo(from + t);
            QCOMPARE(m_bench.servo().value(u"Bus Watchdog"), 4);
            m_bench.bus().advanceTo(from + 95ms);
            QCOMPARE(m_bench.servo().value(u"Bus Watchdog"), -1);
        }
    }

    void settings()
    {
        ServoSettings &settings = m_bench.servo().settings();
        settings.alignmentError = DeviceError::Access;
        m_bench.ask(QStringLiteral("01 03 75 00 00 00 00"), QStringLiteral("01 07"));
        settings.bootTime = 100ms;
        m_bench.client().exchange(QStringLiteral("01 08"));
        m_bench.wait(80ms);
        m_bench.ask(QStringLiteral("01 01"), QStringLiteral("01 00 FC 03 2D"));
    }

    /// Units of error and loop time of the controllers: the PWM against an error of 100 pulses, held by a hand.
    void controllerSettings()
    {
        const auto pwm = [this] {
            m_bench.wait(300ms);
            return m_bench.value(u"Present PWM");
        };
        JointTuning &tuning = m_bench.servo().settings().control;
        m_bench.servo().joint().setExtraInertia(1000); // stays where it is
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Goal Position", 2148);
        QCOMPARE(pwm(), 625); // 100 × 800 / 128
        tuning.positionErrorUnit = 2;
        QVERIFY(qAbs(pwm() - 312) <= 1);
        tuning.positionErrorUnit = 1;
        m_bench.write(u"Position P Gain", 0);
        m_bench.write(u"Position I Gain", 100); // 100 × 100 / 65536 a loop
        m_bench.write(u"Goal Position", 2148);
        const auto before = pwm();
        const auto slow = pwm() - before;
        QVERIFY2(qAbs(slow - 300 * 0.1526) < 3, qPrintable(QString::number(slow)));
        tuning.loopTime = 3;
        const auto from = pwm();
        const auto slower = pwm() - from;
        QVERIFY2(qAbs(slower - slow / 3) < 3, qPrintable(QString::number(slower)));
        m_bench.write(u"Torque Enable", 0);
        m_bench.write(u"Operating Mode", 1);
        tuning.loopTime = 1;
        m_bench.write(u"Torque Enable", 1);
        m_bench.write(u"Velocity I Gain", 0);
        m_bench.write(u"Velocity P Gain", 128);
        m_bench.write(u"Goal Velocity", 100);
        QVERIFY(qAbs(pwm() - 100) <= 3); // in units of Present Velocity
        tuning.velocityErrorUnit = 0.5;
        QVERIFY(qAbs(pwm() - 200) <= 6);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    ServoBench m_bench{m_catalog};
};

DYNASCOPE_CORE_TEST(TestServoRegisters)
#include "tst_servoregisters.moc"
