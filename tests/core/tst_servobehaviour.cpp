// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// What a servo does with its registers over time: reference "What an X servo does with its registers".
class TestServoBehaviour : public QObject
{
    Q_OBJECT

private slots:
    void init() { start(QStringLiteral("XM430-W350"), -1); }

    void torqueOnTakesThePresentPositionAsGoal()
    {
        servo().joint().setShaftAngle(90);
        ask(QStringLiteral("01 03 74 00 00 0C 00 00"), QStringLiteral("01 00"));
        ask(QStringLiteral("01 03 40 00 01"), QStringLiteral("01 00"));
        QCOMPARE(value(u"Goal Position"), 1024);
        wait(500ms);
        QVERIFY(qAbs(value(u"Present Position") - 1024) < 12);
    }

    void orKeepsTheGoalWhereSoSet()
    {
        servo().settings().goalOnTorqueOn = ServoSettings::GoalOnTorqueOn::Stays;
        servo().joint().setShaftAngle(90);
        ask(QStringLiteral("01 03 74 00 00 0C 00 00"), QStringLiteral("01 00"));
        ask(QStringLiteral("01 03 40 00 01"), QStringLiteral("01 00"));
        QCOMPARE(value(u"Goal Position"), 3072);
        wait(3s);
        QVERIFY(qAbs(value(u"Present Position") - 3072) < 20);
    }

    void movesToItsGoalAndSaysSo()
    {
        ask(QStringLiteral("01 03 40 00 01"), QStringLiteral("01 00"));
        write(u"Profile Velocity", 100);
        write(u"Profile Acceleration", 20);
        write(u"Goal Position", 3072);
        wait(200ms);
        QCOMPARE(value(u"Moving"), 1);
        QVERIFY(value(u"Velocity Trajectory") > 0);
        QVERIFY(value(u"Position Trajectory") > 2048);
        wait(3s);
        QCOMPARE(value(u"Moving"), 0);
        QVERIFY(value(u"Moving Status") & 1);
        QVERIFY(qAbs(value(u"Present Position") - 3072) < 20);
    }

    void withoutTorqueAGoalDoesNothing()
    {
        const auto before = value(u"Present Position");
        write(u"Goal Position", 3072);
        wait(1s);
        QCOMPARE(value(u"Present Position"), before);
        QCOMPARE(value(u"Torque Enable"), 0);
    }

    void driveModeBit3TurnsTorqueOnByAGoal()
    {
        write(u"Drive Mode", 8);
        write(u"Goal Position", 3072);
        QCOMPARE(value(u"Torque Enable"), 1);
        QCOMPARE(value(u"Goal Position"), 3072);
        wait(3s);
        QVERIFY(qAbs(value(u"Present Position") - 3072) < 20);
    }

    void aModePutsGainsProfileAndGoalsBack()
    {
        write(u"Position P Gain", 111);
        write(u"Profile Velocity", 50);
        write(u"Profile Acceleration", 5);
        write(u"PWM Limit", 700);
        write(u"Goal PWM", 100);
        write(u"Goal Current", 100);
        write(u"Operating Mode", 4);
        QCOMPARE(value(u"Position P Gain"), 800);
        QCOMPARE(value(u"Profile Velocity"), 0);
        QCOMPARE(value(u"Profile Acceleration"), 0);
        QCOMPARE(value(u"Goal PWM"), 700);
        QCOMPARE(value(u"Goal Current"), 1193);
    }

    void homingOffset_data()
    {
        QTest::addColumn<int>("mode");
        QTest::addColumn<int>("offset");
        QTest::addColumn<int>("position");
        QTest::newRow("added") << 3 << 500 << 1524;
        QTest::newRow("negative") << 3 << -1024 << 0;
        QTest::newRow("too much for Position mode") << 3 << 1025 << 1024;
        QTest::newRow("not for Extended Position mode") << 4 << 5000 << 6024;
    }

    void homingOffset()
    {
        QFETCH(int, mode);
        QFETCH(int, offset);
        QFETCH(int, position);
        servo().joint().setShaftAngle(90);
        write(u"Operating Mode", mode);
        write(u"Homing Offset", offset);
        QCOMPARE(value(u"Present Position"), position);
        QCOMPARE(value(u"Goal Position"), position);
    }

    void turnsAreForgotten_data()
    {
        QTest::addColumn<QString>("packet");
        QTest::addColumn<bool>("forgotten");
        QTest::newRow("nothing done") << "01 01" << false;
        QTest::newRow("Reboot") << "01 08" << true;
        QTest::newRow("to Position mode") << "01 03 0B 00 03" << true;
        QTest::newRow("to Velocity mode") << "01 03 0B 00 01" << false;
        QTest::newRow("torque on in Extended Position mode") << "01 03 40 00 01" << false;
        QTest::newRow("Clear") << "01 10 01 44 58 4C 22" << true;
        QTest::newRow("broadcast Clear") << "FE 10 01 44 58 4C 22" << true;
    }

    void turnsAreForgotten()
    {
        QFETCH(QString, packet);
        QFETCH(bool, forgotten);
        write(u"Operating Mode", 4);
        servo().joint().setShaftAngle(720 + 90);
        QCOMPARE(value(u"Present Position"), 2 * 4096 + 1024);
        m_client->exchange(packet);
        wait(500ms);
        QVERIFY(qAbs(value(u"Present Position") - (forgotten ? 0 : 2 * 4096) - 1024) < 10);
    }

    void clearIsRefusedWhileMoving()
    {
        write(u"Torque Enable", 1);
        write(u"Profile Velocity", 20);
        write(u"Goal Position", 3072);
        wait(300ms);
        ask(QStringLiteral("01 10 01 44 58 4C 22"), QStringLiteral("01 01"));
    }

    void reverseModeTurnsTheDirection()
    {
        servo().joint().setShaftAngle(90);
        write(u"Drive Mode", 1);
        QCOMPARE(value(u"Present Position"), 3072);
        write(u"Homing Offset", 500); // keeps its sign
        QCOMPARE(value(u"Present Position"), 3572);
    }

    void watchdogStopsWhatNobodySpeaksTo()
    {
        write(u"Torque Enable", 1);
        write(u"Profile Velocity", 30);
        write(u"Goal Position", 3500);
        write(u"Bus Watchdog", 5); // 100 ms
        for (int i = 0; i < 5; ++i) // a packet to anybody will do
            m_client->exchange(QStringLiteral("09 01"), 60ms);
        QCOMPARE(value(u"Bus Watchdog"), 5);
        wait(150ms);
        QCOMPARE(value(u"Bus Watchdog"), -1);
        QCOMPARE(value(u"Profile Velocity"), 0);
        const auto stopped = value(u"Present Position");
        QVERIFY(stopped < 3000);
        ask(QStringLiteral("01 03 74 00 00 08 00 00"), QStringLiteral("01 04"));
        wait(1s);
        QVERIFY(qAbs(value(u"Present Position") - stopped) < 20);
        write(u"Bus Watchdog", 0);
        ask(QStringLiteral("01 03 74 00 00 08 00 00"), QStringLiteral("01 00"));
    }

    void watchdogCountsOnlyUnderTorque()
    {
        write(u"Bus Watchdog", 1);
        wait(1s);
        QCOMPARE(value(u"Bus Watchdog"), 1);
    }

    void alertRidesBesideTheAnswer()
    {
        servo().setHardwareError(0x01); // voltage: not in XM430's Shutdown
        ask(QStringLiteral("01 02 46 00 01 00"), QStringLiteral("01 80 01"));
        ask(QStringLiteral("01 03 41 00 02"), QStringLiteral("01 84"));
        ask(QStringLiteral("01 03 40 00 01"), QStringLiteral("01 80"));
        QCOMPARE(value(u"Torque Enable"), 1);
    }

    void shutdownKeepsTorqueOffUntilReboot()
    {
        write(u"Torque Enable", 1);
        servo().setHardwareError(0x20);
        QCOMPARE(value(u"Torque Enable"), 0);
        m_client->exchange(QStringLiteral("01 03 40 00 01"));
        QCOMPARE(value(u"Torque Enable"), 0);
        ask(QStringLiteral("01 08"), QStringLiteral("01 80"));
        wait(400ms);
        QCOMPARE(value(u"Hardware Error Status"), 0);
        ask(QStringLiteral("01 03 40 00 01"), QStringLiteral("01 00"));
        QCOMPARE(value(u"Torque Enable"), 1);
    }

    void lowSupplyIsAHardwareError()
    {
        servo().joint().setSupplyVoltage(8.0);
        wait(100ms);
        QCOMPARE(value(u"Hardware Error Status"), 1);
    }

    void rebootIsDeafForAWhile()
    {
        write(u"LED", 1);
        write(u"Torque Enable", 1);
        wait(2s);
        QVERIFY(value(u"Realtime Tick") > 2000);
        ask(QStringLiteral("01 08"), QStringLiteral("01 00"));
        QVERIFY(m_client->exchange(QStringLiteral("01 01"), 300ms).empty());
        wait(70ms);
        ask(QStringLiteral("01 01"), QStringLiteral("01 00 FC 03 2D"));
        QVERIFY(value(u"Realtime Tick") < 100);
        QCOMPARE(value(u"LED"), 0);
        QCOMPARE(value(u"Torque Enable"), 0);
    }

    void realtimeTickWraps()
    {
        wait(32700ms);
        QVERIFY(value(u"Realtime Tick") >= 32700);
        wait(100ms);
        QVERIFY(value(u"Realtime Tick") < 100);
    }

    void factoryReset_data()
    {
        QTest::addColumn<int>("firmware");
        QTest::addColumn<QString>("packet");
        QTest::addColumn<int>("id");
        QTest::addColumn<int>("baud");
        QTest::addColumn<int>("delay"); // Return Delay Time: 250 after a reset
        QTest::newRow("all") << 45 << "05 06 FF" << 1 << 57600 << 250;
        QTest::newRow("all but ID") << 45 << "05 06 01" << 5 << 57600 << 250;
        QTest::newRow("all but ID and baud") << 45 << "05 06 02" << 5 << 1000000 << 250;
        QTest::newRow("broadcast of all is ignored") << 45 << "FE 06 FF" << 5 << 1000000 << 10;
        QTest::newRow("old firmware obeys it") << 41 << "FE 06 FF" << 1 << 57600 << 250;
        QTest::newRow("broadcast of the rest is not ignored") << 45 << "FE 06 02" << 5 << 1000000 << 250;
    }

    void factoryReset()
    {
        QFETCH(int, firmware);
        QFETCH(QString, packet);
        QFETCH(int, id);
        QFETCH(int, baud);
        QFETCH(int, delay);
        start(QStringLiteral("XM430-W350"), firmware, 1000000, 5);
        write(u"Return Delay Time", 10);
        const Bytes heard = m_client->exchange(packet);
        QCOMPARE(hex(heard), packet.startsWith(u"FE") ? QString() : hex(status(QStringLiteral("05 00"))));
        QCOMPARE(servo().id(), id);
        QCOMPARE(servo().baudRate(), baud);
        QCOMPARE(value(u"Return Delay Time"), delay);
        QCOMPARE(value(u"Model Number"), 1020);
        QCOMPARE(servo().firmware(), firmware);
    }

    void backupAndRestore()
    {
        write(u"Return Delay Time", 20);
        ask(QStringLiteral("01 20 01 43 54 52 4C"), QStringLiteral("01 00"));
        write(u"Return Delay Time", 30);
        ask(QStringLiteral("01 20 02 43 54 52 4C"), QStringLiteral("01 00"));
        QVERIFY(servo().isDeaf(m_client->now));
        wait(400ms);
        QCOMPARE(value(u"Return Delay Time"), 20);
        QCOMPARE(value(u"Backup Ready"), 1);
    }

    void startupConfiguration()
    {
        write(u"Position P Gain", 555);
        ask(QStringLiteral("01 20 01 43 54 52 4C"), QStringLiteral("01 00"));
        write(u"Startup Configuration", 3);
        m_client->exchange(QStringLiteral("01 08"), 500ms);
        QCOMPARE(value(u"Torque Enable"), 1);
        QCOMPARE(value(u"Position P Gain"), 555);
    }

    void anEepromWriteTakesLonger()
    {
        m_client->exchange(QStringLiteral("01 03 41 00 01"));
        const LineTime ram = m_client->firstByte;
        m_client->exchange(QStringLiteral("01 03 0C 00 FF"));
        QCOMPARE(m_client->firstByte - ram, servo().settings().eepromWrite);
    }

    void settings()
    {
        servo().settings().answersDamagedRequests = true;
        Bytes damaged = instruction(QStringLiteral("01 01"));
        damaged.back() ^= 0x01;
        QCOMPARE(hex(m_client->exchange(damaged)), hex(status(QStringLiteral("01 03"))));
        servo().settings().limitError = DeviceError::DataRange;
        write(u"Max Position Limit", 2048);
        ask(QStringLiteral("01 03 74 00 01 08 00 00"), QStringLiteral("01 04"));
        servo().settings().idChangeAnswersWithNewId = true;
        ask(QStringLiteral("01 03 07 00 09"), QStringLiteral("09 00"));
        servo().settings().answersReboot = false;
        ask(QStringLiteral("09 08"), QString());
    }

    void aDamagedRequestIsNotAnswered()
    {
        Bytes damaged = instruction(QStringLiteral("01 01"));
        damaged.back() ^= 0x01;
        QVERIFY(m_client->exchange(damaged).empty());
        ask(QStringLiteral("01 01"), QStringLiteral("01 00 FC 03 2D"));
    }

    void anotherProtocolIsSilence()
    {
        ask(QStringLiteral("01 03 0D 00 01"), QStringLiteral("01 00"));
        QVERIFY(m_client->exchange(QStringLiteral("01 01")).empty());
    }

    void modelsDiffer_data()
    {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answer");
        QTest::newRow("XL430 has no Goal Current") << "XL430-W250" << "01 03 66 00 00 00" << "01 07";
        QTest::newRow("XL430 has no current mode") << "XL430-W250" << "01 03 0B 00 00" << "01 04";
        QTest::newRow("XL330 has no 4.5 Mbps") << "XL330-M288" << "01 03 08 00 07" << "01 04";
        QTest::newRow("XL330's table is shorter") << "XL330-M288" << "01 02 FB 00 02 00" << "01 07";
        QTest::newRow("XL330 stands at 5 V") << "XL330-M288" << "01 02 46 00 01 00" << "01 00 00";
        QTest::newRow("XL430 at 11.1 V") << "XL430-W250" << "01 02 46 00 01 00" << "01 00 00";
    }

    void modelsDiffer()
    {
        QFETCH(QString, model);
        QFETCH(QString, request);
        QFETCH(QString, answer);
        start(model, -1);
        wait(1s);
        ask(request, answer);
    }

private:
    void start(const QString &model, int firmware, int baud = 57600, int id = 1)
    {
        m_bus = std::make_unique<SimulatedBus>(m_catalog);
        QVERIFY(m_bus->add({model, firmware, baud, id}));
        m_client.emplace(Client{*m_bus, baud});
    }
    Servo &servo() { return *m_bus->servos().front(); }
    std::int64_t value(QStringView name)
    {
        m_bus->advanceTo(m_client->now);
        return servo().value(name);
    }
    /// By the wire, as any client.
    void write(QStringView name, std::int64_t raw)
    {
        const Field *field = servo().table().find(name);
        QVERIFY(field);
        Bytes parameters;
        appendLittleEndian(parameters, field->address, 2);
        const Bytes data = bytesFromRaw(*field, raw);
        parameters.insert(parameters.end(), data.begin(), data.end());
        const auto id = static_cast<std::uint8_t>(servo().id());
        QCOMPARE(hex(m_client->exchange(oracle::instruction(id, 3, parameters))), hex(oracle::status(id, 0, {})));
    }
    void ask(const QString &request, const QString &answer)
    {
        QCOMPARE(hex(m_client->exchange(request)), hex(status(answer)));
    }
    void wait(LineTime duration)
    {
        m_client->now += duration;
        m_bus->advanceTo(m_client->now);
    }

    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<SimulatedBus> m_bus;
    std::optional<Client> m_client;
};

DYNASCOPE_CORE_TEST(TestServoBehaviour)
#include "tst_servobehaviour.moc"
