// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/parser.h"
#include "tests/support/dxlbus.h"
#include "tests/support/oracle.h"
#include "tests/support/ptymaster.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;

namespace {

/// As `dxl packet` prints one.
QString line(QChar direction, const Bytes &bytes, const QString &says)
{
    const QByteArray raw(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    return direction + u' ' + QString::fromLatin1(raw.toHex(' ').toUpper()) + u"  "_s + says + u'\n';
}

} // namespace

/// What dxl does to devices beyond registers: reboot, reset, clear, backup, STOP, packets.
class TestDxlActions : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:2,XL430-W250@57600:4,XL330-M288@1000000:7"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void reboots()
    {
        m_bus->set(2, 57600, u"LED", 1);
        m_bus->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(2, 57600)->setHardwareError(0x20); });
        const Outcome outcome = m_bus->dxl(u"reboot 2,4");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QVERIFY2(outcome.out.startsWith(u"XM430-W350 (ID 2): back 0."), qPrintable(outcome.out));
        QVERIFY(outcome.out.contains(u"XL430-W250 (ID 4): back 0."));
        QCOMPARE(m_bus->value(2, 57600, u"LED"), 0);
        QCOMPARE(m_bus->value(2, 57600, u"Hardware Error Status"), 0);
    }

    void resets_data()
    {
        QTest::addColumn<QString>("option");
        QTest::addColumn<int>("id");
        QTest::addColumn<int>("baudRate");
        QTest::newRow("all") << u"all"_s << 1 << 57600;
        QTest::newRow("all but ID") << u"all-but-id"_s << 7 << 57600;
        QTest::newRow("all but ID and baud") << u"all-but-id-and-baud"_s << 7 << 1000000;
    }

    void resets()
    {
        QFETCH(QString, option);
        QFETCH(int, id);
        QFETCH(int, baudRate);
        m_bus->set(7, 1000000, u"Return Delay Time", 3);
        const QStringList reset{u"--baud"_s, u"1000000"_s, u"reset"_s, option, u"7"_s};
        // Nobody to ask, and nobody has agreed: nothing goes over the wire.
        m_bus->forget();
        const Outcome refused = m_bus->dxl(reset);
        QCOMPARE(refused.code, 2);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"--yes"), qPrintable(refused.err));
        QVERIFY(m_bus->sent().empty());
        QCOMPARE(m_bus->value(7, 1000000, u"Return Delay Time"), 3);

        const Outcome done = m_bus->dxl(reset + QStringList{u"--yes"_s, u"--json"_s});
        QCOMPARE(done.err, QString());
        QCOMPARE(done.code, 0);
        QCOMPARE(QJsonDocument::fromJson(done.out.toUtf8()).object(),
                 QJsonObject({{u"id"_s, 7}, {u"reset"_s, option}, {u"now_id"_s, id}, {u"now_baud"_s, baudRate}}));
        QCOMPARE(m_bus->value(id, baudRate, u"Return Delay Time"), 250);
    }

    void resetKeepsOffATakenPlace()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2"_s);
        const Outcome outcome = m_bus->dxl(u"reset all 2 --yes");
        QCOMPARE(outcome.code, 1);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"taken"), qPrintable(outcome.err));
        QCOMPARE(m_bus->dxl(u"ping 1,2").code, 0);
    }

    void resetsThatWouldMeetAreRefusedBeforeTheFirst()
    {
        m_bus->set(2, 57600, u"Return Delay Time", 3);
        const Outcome outcome = m_bus->dxl(u"reset all 2,4 --yes");
        QCOMPARE(outcome.code, 2);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"would both end at ID 1 at 57600 bps"),
                 qPrintable(outcome.err));
        QCOMPARE(m_bus->value(2, 57600, u"Return Delay Time"), 3);
        QCOMPARE(m_bus->dxl(u"reset all-but-id 2,4 --yes").code, 0);
        QCOMPARE(m_bus->value(2, 57600, u"Return Delay Time"), 250);
    }

    void resetAsksAPerson_data()
    {
        QTest::addColumn<QByteArray>("answer");
        QTest::addColumn<int>("code");
        QTest::newRow("yes") << QByteArray("yes\n") << 0;
        QTest::newRow("no") << QByteArray("no\n") << 2;
        QTest::newRow("return") << QByteArray("\n") << 2;
        QTest::newRow("y is not enough") << QByteArray("y\n") << 2;
    }

    void resetAsksAPerson()
    {
        QFETCH(QByteArray, answer);
        QFETCH(int, code);
        m_bus->set(2, 57600, u"Return Delay Time", 3);
        PtyMaster person;
        person.write(Bytes(answer.begin(), answer.end()));
        QProcess process;
        process.setStandardInputFile(person.path());
        process.start(QStringLiteral(DYNASCOPE_BIN_DIR "/dxl"), m_bus->with({u"reset"_s, u"all-but-id"_s, u"2"_s}));
        QVERIFY(process.waitForFinished());
        QCOMPARE(process.exitCode(), code);
        const QByteArray says = process.readAllStandardError();
        QVERIFY2(
            says.startsWith("dxl: a Factory Reset (all-but-id) of device 2 overwrites the EEPROM (the baud rate "
                            "goes, too, the ID stays). Type yes to go on:"),
            says.constData());
        QCOMPARE(m_bus->value(2, 57600, u"Return Delay Time"), code == 0 ? 250 : 3);
    }

    void clears()
    {
        QCOMPARE(m_bus->dxl(u"write 2 operating_mode=4").code, 0); // several turns
        m_bus->call(
            [](sim::SimulatedBus &bus, LineTime) { bus.servo(2, 57600)->joint().setShaftAngle(3 * 360 + 180); });
        const Outcome outcome = m_bus->dxl(u"clear position 2");
        QCOMPARE(outcome.err, QString());
        QVERIFY2(outcome.out.startsWith(u"Present Position = 20"),
                 qPrintable(outcome.out)); // 2048, a pulse more or less
        const Outcome refused = m_bus->dxl(u"clear error 2");
        QCOMPARE(refused.code, 1);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"Data Range Error"), qPrintable(refused.err));
    }

    void backsUp()
    {
        m_bus->set(2, 57600, u"Return Delay Time", 3);
        const Outcome stored = m_bus->dxl(u"backup store 2");
        QCOMPARE(stored.err, QString());
        QCOMPARE(stored.out, u"XM430-W350 (ID 2): control table stored\n"_s);
        m_bus->set(2, 57600, u"Return Delay Time", 100);
        QCOMPARE(m_bus->dxl(u"backup restore 2").code, 2); // overwrites EEPROM
        QCOMPARE(m_bus->value(2, 57600, u"Return Delay Time"), 100);
        const Outcome restored = m_bus->dxl(u"backup restore 2 --yes");
        QCOMPARE(restored.err, QString());
        QCOMPARE(restored.out, u"XM430-W350 (ID 2): control table restored\n"_s);
        QCOMPARE(m_bus->value(2, 57600, u"Return Delay Time"), 3);
        m_bus->set(2, 57600, u"Torque Enable", 1);
        const Outcome refused = m_bus->dxl(u"backup store 2");
        QCOMPARE(refused.code, 1);
        QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"torque is on"), qPrintable(refused.err));
    }

    void stops_data()
    {
        QTest::addColumn<QString>("arguments");
        QTest::newRow("whoever is there") << u"stop"_s;
        QTest::newRow("by ID") << u"stop 2,4"_s;
    }

    void stops()
    {
        QFETCH(QString, arguments);
        torqueOn();
        const Outcome outcome = m_bus->dxl(arguments.split(u' '));
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out, u"ID 2: XM430-W350, torque is off\nID 4: XL430-W250, torque is off\n"_s);
        QCOMPARE(outcome.code, 0);
        QCOMPARE(torques(), (std::vector<std::int64_t>{0, 0, 1})); // the last is at another rate
        for (const InstructionPacket &packet : sent())
            QVERIFY(!(packet.id == BroadcastId && packet.instruction == Instruction::Write));
    }

    void stopsAtAllRates()
    {
        torqueOn();
        const Outcome outcome = m_bus->dxl(u"--json stop --bauds all");
        QCOMPARE(outcome.code, 0);
        QCOMPARE(torques(), (std::vector<std::int64_t>{0, 0, 0}));
        const QJsonArray list = QJsonDocument::fromJson(outcome.out.toUtf8()).array();
        QCOMPARE(list.size(), 3);
        QCOMPARE(list[2].toObject(),
                 QJsonObject({{u"id"_s, 7}, {u"baud"_s, 1000000}, {u"model"_s, u"XL330-M288"_s}, {u"off"_s, true}}));
    }

    void stopsBeforeAnythingIsAsked()
    {
        torqueOn();
        m_bus->forget();
        const Outcome outcome = m_bus->dxl(u"stop 2,4 --model XM430-W350");
        QCOMPARE(outcome.code, 0);
        const std::vector<InstructionPacket> packets = sent();
        QVERIFY(!packets.empty());
        QCOMPARE(packets.front().instruction, Instruction::SyncWrite);
        QCOMPARE(torques(), (std::vector<std::int64_t>{0, 0, 1}));
    }

    void stopTellsEachAtOnce()
    {
        torqueOn();
        m_bus->forget();
        QCOMPARE(m_bus->dxl(u"stop 2,4").code, 0);
        const std::vector<InstructionPacket> packets = sent();
        QVERIFY(packets.size() > 4);
        QCOMPARE(packets[0].instruction, Instruction::Ping);
        QCOMPARE(packets[1].instruction, Instruction::SyncWrite); // 4 has not been asked yet
        QCOMPARE(packets[1].parameters, (Bytes{64, 0, 1, 0, 2, 0}));
    }

    void stopSaysWhoIsNotConfirmed()
    {
        torqueOn();
        m_bus->set(4, 57600, u"Status Return Level", 0);
        const Outcome mute = m_bus->dxl(u"stop");
        QCOMPARE(mute.code, 3);
        QVERIFY2(mute.out.contains(u"ID 2: XM430-W350, torque is off\nID 4: XL430-W250, not confirmed: device 4"),
                 qPrintable(mute.out));
        QCOMPARE(torques(), (std::vector<std::int64_t>{0, 0, 1})); // told nevertheless
        const Outcome silent = m_bus->dxl(u"stop 2,9");
        QCOMPARE(silent.code, 1);
        QVERIFY2(silent.out.contains(u"ID 9: not confirmed: device 9 did not answer"), qPrintable(silent.out));
        const Outcome nobody = m_bus->dxl(u"--baud 115200 stop");
        QCOMPARE(nobody.code, 1);
        QVERIFY2(isOneSentence(nobody.err) && nobody.err.contains(u"nobody is known to be off"),
                 qPrintable(nobody.err));
    }

    void packets_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("printed");
        const QString ping =
            line(u'>', oracle::instruction(2, 0x01, {}), u"Ping, ID 2"_s)
            + line(u'<', oracle::status(2, 0, {0xFC, 0x03, 45}), u"Status, ID 2: no error, model 1020, firmware 45"_s);
        QTest::newRow("ping") << QStringList{u"ping"_s, u"2"_s} << ping;
        QTest::newRow("without CRC") << QStringList{u"--hex"_s, u"FF FF FD 00 02 03 00 01"_s} << ping;
        QTest::newRow("with CRC") << QStringList{u"--hex"_s, u"fffffd00020300011972"_s} << ping;
        QTest::newRow("read") << QStringList{u"read"_s, u"2"_s, u"0x84"_s, u"4"_s}
                              << line(u'>', oracle::instruction(2, 0x02, {132, 0, 4, 0}),
                                      u"Read, ID 2: 4 bytes at 132"_s)
                                     + line(u'<', oracle::status(2, 0, {0, 8, 0, 0}),
                                            u"Status, ID 2: no error, 132 = 00 08 00 00"_s);
        QTest::newRow("nobody answers") << QStringList{u"write"_s, u"254"_s, u"65"_s, u"1"_s}
                                        << line(u'>', oracle::instruction(254, 0x03, {65, 0, 1}),
                                                u"Write, everybody: 65 = 01"_s);
        QTest::newRow("as it is") << QStringList{u"--raw"_s, u"--hex"_s, u"FF FF FD 00 02 03 00 01 19 73"_s}
                                  << u"> FF FF FD 00 02 03 00 01 19 73  damaged: its CRC is wrong\n"_s;
    }

    void packets()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, printed);
        const Outcome outcome = m_bus->dxl(QStringList{u"packet"_s} + arguments);
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out, printed);
        QCOMPARE(outcome.code, 0);
    }

    void packetAnswersOfSeveral()
    {
        const Outcome sync = m_bus->dxl(u"packet sync-read 132 4 2 4");
        QCOMPARE(sync.out.count(u"\n< "), 2);
        QVERIFY(sync.out.contains(u"Sync Read: ID 2: 4 bytes at 132; ID 4: 4 bytes at 132"));
        const Outcome fast = m_bus->dxl(u"packet fast-sync-read 132 4 2 4");
        QVERIFY2(
            fast.out.contains(u"fast Status, ID 2: no error, 132 = 00 08 00 00; ID 4: no error, 132 = 00 08 00 00"),
            qPrintable(fast.out));
        QCOMPARE(m_bus->dxl(u"packet ping 254").out.count(u"\n< "), 2);
        const Outcome bulk = m_bus->dxl(u"packet bulk-read 2:132:4 4:7:1");
        QVERIFY2(bulk.out.contains(u"Status, ID 4: no error, 7 = 04"), qPrintable(bulk.out));
        QCOMPARE(m_bus->dxl(u"packet sync-write 65 2=1 4=1").code, 0);
        QTRY_COMPARE(m_bus->value(4, 57600, u"LED"), 1);
    }

    void packetInJson()
    {
        const Outcome outcome = m_bus->dxl(u"--json packet read 2 2000 1");
        QCOMPARE(outcome.code, 0);
        const QJsonObject document = QJsonDocument::fromJson(outcome.out.toUtf8()).object();
        QCOMPARE(document[u"sent"][u"text"].toString(), u"Read, ID 2: 1 byte at 2000"_s);
        const QJsonObject answer = document[u"answers"][0].toObject();
        QCOMPARE(answer[u"id"].toInt(), 2);
        QCOMPARE(answer[u"error"].toInt(), 7);
        QCOMPARE(answer[u"data"].toString(), QString());
    }

    void packetWithoutAnswer()
    {
        const Outcome outcome = m_bus->dxl(u"packet ping 9");
        QCOMPARE(outcome.code, 1);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"nothing answered"), qPrintable(outcome.err));
    }

    void packetRefusesWhatContradictsItself_data()
    {
        QTest::addColumn<QString>("hex");
        QTest::addColumn<QString>("says");
        QTest::newRow("CRC") << u"FF FF FD 00 02 03 00 01 19 73"_s << u"CRC should be 19 72"_s;
        QTest::newRow("length") << u"FF FF FD 00 02 09 00 01"_s << u"16 bytes with CRC, there are 8"_s;
        QTest::newRow("header") << u"FF FF FC 00 02 03 00 01"_s << u"begins with FF FF FD 00"_s;
        QTest::newRow("digits") << u"FF FF F"_s << u"pairs of hexadecimal digits"_s;
        QTest::newRow("nothing") << u"  "_s << u"pairs of hexadecimal digits"_s;
    }

    void packetRefusesWhatContradictsItself()
    {
        QFETCH(QString, hex);
        QFETCH(QString, says);
        const Outcome outcome = m_bus->dxl(QStringList{u"packet"_s, u"--hex"_s, hex});
        QCOMPARE(outcome.code, 2);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(says), qPrintable(outcome.err));
    }

private:
    void torqueOn()
    {
        m_bus->set(2, 57600, u"Torque Enable", 1);
        m_bus->set(4, 57600, u"Torque Enable", 1);
        m_bus->set(7, 1000000, u"Torque Enable", 1);
    }
    std::vector<std::int64_t> torques()
    {
        return {m_bus->value(2, 57600, u"Torque Enable"), m_bus->value(4, 57600, u"Torque Enable"),
                m_bus->value(7, 1000000, u"Torque Enable")};
    }
    std::vector<InstructionPacket> sent()
    {
        Parser parser;
        for (const Bytes &bytes : m_bus->sent())
            parser.feed(bytes);
        std::vector<InstructionPacket> packets;
        while (const auto event = parser.next()) {
            if (const auto *packet = std::get_if<Parser::Packet>(&*event))
                packets.push_back(packet->request());
        }
        return packets;
    }

    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlActions)
#include "tst_dxlactions.moc"
