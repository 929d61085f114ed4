// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/parser.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;

/// `dxl write` to several devices, and where something goes wrong in the middle.
class TestDxlWrite : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2,XL430-W250@57600:4"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void ramIsWrittenAtOnce()
    {
        const Outcome outcome = m_bus->dxl(u"write 1,2,4 torque_enable=on goal_position=90deg 65:1=1");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QString expected;
        for (const int id : {1, 2, 4}) {
            expected += u"ID %1: Torque Enable = 1 (On)\nID %1: Goal Position = 1024 (90.00 °)\nID %1: 65:1 = 1 (0x01)\n"_s
                            .arg(id);
        }
        QCOMPARE(outcome.out, expected);
        QCOMPARE(instructions(Instruction::SyncWrite), 3); // one a register
        QCOMPARE(instructions(Instruction::Write), 0);
    }

    /// A request that the device turns into its answer: reading back the answer is success, of several devices, too.
    void hybridRegistersAreSaved()
    {
        DxlBus bus(u"YM070-210-R051-RH@57600:1,YM070-210-R051-RH@57600:2"_s);
        const QStringList save{u"write"_s, u"1,2"_s, u"Hybrid Save=1"_s};
        const Outcome outcome = bus.dxl(save);
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out, u"ID 1: Hybrid Save = 2 (Saved)\nID 2: Hybrid Save = 2 (Saved)\n"_s);
        QCOMPARE(outcome.code, 0);
        bus.call([](sim::SimulatedBus &there, LineTime) { there.servo(2, 57600)->write(u"Torque Enable", 1); });
        const Outcome refused = bus.dxl(save); // the table says that it needs torque off
        QCOMPARE(refused.code, 1);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"orque"), qPrintable(refused.err));
    }

    void eepromIsWrittenToOneAfterTheOther()
    {
        const Outcome outcome = m_bus->dxl(u"write 1,2 return_delay_time=0 led=on");
        QCOMPARE(outcome.err, QString());
        QVERIFY2(outcome.out.startsWith(u"ID 1: Return Delay Time = 0 (0 µs)\nID 1: LED = 1 (On)\nID 2: "),
                 qPrintable(outcome.out));
        QCOMPARE(instructions(Instruction::SyncWrite), 0);
    }

    void whatItWouldBring()
    {
        m_bus->call([](sim::SimulatedBus &bus, LineTime) {
            bus.servo(1, 57600)->write(u"Position P Gain", 640);
            bus.servo(1, 57600)->write(u"Torque Enable", 1);
        });
        const Outcome outcome = m_bus->dxl(u"write 1 operating_mode=4 led=on --explain");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QVERIFY2(outcome.out.startsWith(u"Operating Mode: Operating Mode is locked while torque is on"_s),
                 qPrintable(outcome.out));
        QVERIFY2(outcome.out.contains(u"\n    Position P Gain: 640 → 800\n"_s), qPrintable(outcome.out));
        QVERIFY2(outcome.out.endsWith(u"LED: nothing besides its value\n"_s), qPrintable(outcome.out));
        QCOMPARE(instructions(Instruction::Write), 0);
        const Outcome json = m_bus->dxl(u"--json write 1 operating_mode=4 --explain");
        const QJsonArray all = QJsonDocument::fromJson(json.out.toUtf8()).array();
        QCOMPARE(all.size(), 2);
        QCOMPARE(all.at(1)[u"consequence"_s].toString(), u"resets"_s);
        QCOMPARE(all.at(1)[u"registers"_s].toArray().first()[u"register"_s].toString(), u"Position P Gain"_s);
    }

    void theSafeWay_data()
    {
        QTest::addColumn<bool>("torqueBack");
        QTest::newRow("torque stays off") << false;
        QTest::newRow("torque comes back") << true;
    }
    void theSafeWay()
    {
        QFETCH(bool, torqueBack);
        m_bus->call([](sim::SimulatedBus &bus, LineTime) {
            for (const int id : {1, 2}) {
                bus.servo(id, 57600)->write(u"Position P Gain", 640);
                bus.servo(id, 57600)->write(u"Torque Enable", 1);
            }
        });
        QStringList words{u"write"_s, u"1,2"_s, u"led=on"_s, u"operating_mode=4"_s, u"--safely"_s};
        if (torqueBack)
            words << u"--torque-back"_s;
        const Outcome outcome = m_bus->dxl(words);
        QVERIFY2(outcome.code == 0, qPrintable(outcome.err));
        QVERIFY2(outcome.out.startsWith(u"ID 1: Operating Mode = 4 (Extended position control)\n"_s),
                 qPrintable(outcome.out));
        QVERIFY2(outcome.out.contains(u"ID 2: Position P Gain = 640\n"_s), qPrintable(outcome.out));
        QVERIFY2(outcome.err.contains(torqueBack ? u"ID 1: torque is on, with the goal at rest"_s
                                                 : u"ID 1: torque was turned off for it, and stays off"_s),
                 qPrintable(outcome.err));
        m_bus->call([torqueBack](sim::SimulatedBus &bus, LineTime) {
            for (const int id : {1, 2}) {
                sim::Servo &servo = *bus.servo(id, 57600);
                QCOMPARE(servo.value(u"Operating Mode"), 4);
                QCOMPARE(servo.value(u"Position P Gain"), 640);
                QCOMPARE(servo.value(u"LED"), 1);
                QCOMPARE(servo.value(u"Torque Enable"), torqueBack ? 1 : 0);
            }
        });
        m_bus->forget();
        QCOMPARE(m_bus->dxl(words).code, 0);
        QCOMPARE(instructions(Instruction::Write), 0); // all of it was so already
    }

    void theSafeWayIsRefused_data()
    {
        QTest::addColumn<QStringList>("words");
        QTest::addColumn<QString>("says");
        QTest::newRow("ID") << QStringList{u"id=7"_s, u"--safely"_s} << u"ID is not changed among other settings"_s;
        QTest::newRow("torque off") << QStringList{u"torque_enable=off"_s, u"--safely"_s} << u"Torque Enable is no setting"_s;
        QTest::newRow("twice") << QStringList{u"led=on"_s, u"led=off"_s, u"--safely"_s} << u"LED is wanted twice"_s;
        QTest::newRow("no register") << QStringList{u"100:3=1"_s, u"--safely"_s} << u"nobody knows what 100:3 is"_s;
        QTest::newRow("both") << QStringList{u"led=on"_s, u"--safely"_s, u"--explain"_s} << u"one of them"_s;
        QTest::newRow("alone") << QStringList{u"led=on"_s, u"--torque-back"_s} << u"--torque-back belongs to --safely"_s;
    }
    void theSafeWayIsRefused()
    {
        QFETCH(QStringList, words);
        QFETCH(QString, says);
        const Outcome outcome = m_bus->dxl(QStringList{u"write"_s, u"1"_s} + words);
        QCOMPARE(outcome.code, 2);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(says), qPrintable(outcome.err));
        QCOMPARE(instructions(Instruction::Write), 0);
    }

    /// A name is each device's own register, by its firmware; an address that isn't the same one is refused.
    void eachItsOwnAddress()
    {
        DxlBus bus(u"XL330-M288/52@57600:1,XL330-M288/53@57600:2,XL330-M288/51@57600:3"_s);
        bus.call([](sim::SimulatedBus &there, LineTime) {
            for (const int id : {1, 2, 3})
                there.servo(id, 57600)->write(u"Indirect Address 1", 65); // LED
        });
        bus.forget();
        const Outcome outcome = bus.dxl(QStringList{u"write"_s, u"1,2,3"_s, u"Indirect Data 1=1"_s});
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        int groups = 0;
        for (const Bytes &packet : bus.sent()) {
            groups += packet[7] == static_cast<std::uint8_t>(Instruction::SyncWrite)
                      || packet[7] == static_cast<std::uint8_t>(Instruction::BulkWrite);
        }
        QCOMPARE(groups, 2); // firmware 51 and 52 in one
        bus.call([](sim::SimulatedBus &there, LineTime) {
            for (const int id : {1, 2, 3})
                QCOMPARE(there.servo(id, 57600)->value(u"LED"), 1);
        });
        bus.forget();
        const Outcome refused = bus.dxl(QStringList{u"write"_s, u"1,2,3"_s, u"led=off"_s, u"224:1=0"_s});
        QCOMPARE(refused.code, 2);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"224:1 is Indirect Data 17 of"_s),
                 qPrintable(refused.err));
        const Outcome missing = bus.dxl(QStringList{u"write"_s, u"1,2,3"_s, u"led=off"_s, u"Indirect Data 21=0"_s});
        QCOMPARE(missing.code, 2);
        bus.call([](sim::SimulatedBus &there, LineTime) {
            for (const int id : {1, 2, 3})
                QCOMPARE(there.servo(id, 57600)->value(u"LED"), 1);
        });
    }

    void whoRefusesSaysWhy()
    {
        // Nobody answers a Sync Write: that the watchdog has tripped is said by the device to which it is written alone.
        m_bus->call([](sim::SimulatedBus &bus, LineTime) {
            bus.servo(2, 57600)->write(u"Bus Watchdog", 1);
            bus.servo(2, 57600)->write(u"Torque Enable", 1);
        });
        QTRY_COMPARE(m_bus->value(2, 57600, u"Bus Watchdog"), -1);
        const Outcome outcome = m_bus->dxl(u"--json write 1,2 led=on goal_position=90deg profile_velocity=10");
        QCOMPARE(outcome.code, 1);
        const QJsonArray all = QJsonDocument::fromJson(outcome.out.toUtf8()).array();
        QVERIFY2(outcome.err.contains(u"ID 2: goal_position: device 2 refused: Data Range Error"), qPrintable(outcome.err));
        QVERIFY2(outcome.err.contains(u"written before it: led"), qPrintable(outcome.err));
        QVERIFY(all[0][u"raw"].toInt() == 1);
        QCOMPARE(m_bus->value(1, 57600, u"Goal Position"), 1024); // the other is none the worse for it
    }

    void whoIsMuteIsToldAsWell()
    {
        m_bus->set(1, 57600, u"Status Return Level", 0);
        const Outcome outcome = m_bus->dxl(u"write 1,2 led=on");
        QCOMPARE(outcome.code, 3);
        QCOMPARE(outcome.out, u"ID 2: LED = 1 (On)\n"_s);
        QVERIFY2(outcome.err.contains(u"ID 1: led: sent, but not confirmed"), qPrintable(outcome.err));
        QCOMPARE(m_bus->value(1, 57600, u"LED"), 1);
    }

    /// A limit that can't be read is no limit that isn't there.
    void limitsThatAreNotHeard()
    {
        sim::LineFaults faults;
        sim::ReplyFault lost;
        lost.skip = 3; // Ping, Status Return Level, Operating Mode: then the limits are read
        lost.times = -1;
        faults.replies = {lost};
        m_bus->call([&](sim::SimulatedBus &bus, LineTime) { bus.setFaults(faults); });
        const Outcome outcome = test::dxl({u"--port"_s, m_bus->path(), u"--timeout"_s, u"100"_s, u"write"_s, u"1"_s,
                                           u"goal_position=4096"_s});
        QCOMPARE(outcome.code, 1);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"device 1 did not answer")
                     && outcome.err.contains(u"nothing was written"),
                 qPrintable(outcome.err));
    }

private:
    /// How many packets of this instruction went over the wire.
    int instructions(Instruction wanted)
    {
        Parser parser;
        for (const Bytes &bytes : m_bus->sent())
            parser.feed(bytes);
        int count = 0;
        while (const auto event = parser.next()) {
            const auto *packet = std::get_if<Parser::Packet>(&*event);
            count += packet && packet->instruction == wanted ? 1 : 0;
        }
        return count;
    }

    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlWrite)
#include "tst_dxlwrite.moc"
