// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/parser.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::isOneSentence;
using dynascope::test::Outcome;

namespace {

QJsonArray list(const Outcome &outcome)
{
    return QJsonDocument::fromJson(outcome.out.toUtf8()).array();
}

} // namespace

/// Commands for several devices at once, and those that look at a whole device.
class TestDxlMany : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XM430-W350@57600:2,XL430-W250@57600:4"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void pingsSeveral()
    {
        const Outcome outcome = m_bus->dxl(u"ping 1-3,4");
        QCOMPARE(outcome.out,
                 u"ID 1: XM430-W350 (model 1020), firmware 45\nID 2: XM430-W350 (model 1020), firmware 45\n"
                 u"ID 4: XL430-W250 (model 1060), firmware 45\n"_s);
        QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"device 3 did not answer"),
                 qPrintable(outcome.err));
        QCOMPARE(outcome.code, 1);

        const Outcome document = m_bus->dxl(u"--json ping 1,3");
        QCOMPARE(list(document).size(), 2);
        QCOMPARE(list(document)[0][u"model"].toString(), u"XM430-W350"_s);
        QCOMPARE(list(document)[1][u"id"].toInt(), 3);
        QVERIFY(list(document)[1][u"error"].toString().contains(u"did not answer"));
    }

    void readsSeveralInOneExchange()
    {
        const Outcome outcome = m_bus->dxl(u"read 1,2,4 present_position 9:1");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out, u"ID 1: Present Position = 2048 (180.00 °)\nID 1: 9:1 = 250 (0xfa)\n"
                              u"ID 2: Present Position = 2048 (180.00 °)\nID 2: 9:1 = 250 (0xfa)\n"
                              u"ID 4: Present Position = 2048 (180.00 °)\nID 4: 9:1 = 250 (0xfa)\n"_s);
        QCOMPARE(outcome.code, 0);
        QCOMPARE(instructions(Instruction::SyncRead), 2); // one for each register
        QCOMPARE(instructions(Instruction::Read), 3);     // of each device's Status Return Level
    }

    void readsWhoAnswers()
    {
        const Outcome outcome = m_bus->dxl(u"--json read 1,3,4 132:4");
        QCOMPARE(outcome.code, 1);
        const QJsonArray all = list(outcome);
        QCOMPARE(all.size(), 3);
        QCOMPARE(all[0].toObject(),
                 QJsonObject({{u"id"_s, 1}, {u"address"_s, 132}, {u"length"_s, 4}, {u"raw"_s, 2048}}));
        QVERIFY(all[1][u"error"].toString().contains(u"device 3"));
        QCOMPARE(all[2][u"raw"].toInt(), 2048);
    }

    void writesToSeveral()
    {
        const Outcome outcome = m_bus->dxl(u"write 1,2,4 led=on profile_velocity=100");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.out.count(u"LED = 1 (On)"), 3);
        QVERIFY2(outcome.out.startsWith(u"ID 1: LED = 1 (On)\nID 1: Profile Velocity = 100 ("),
                 qPrintable(outcome.out));
        for (const int id : {1, 2, 4})
            QCOMPARE(m_bus->value(id, 57600, u"Profile Velocity"), 100);
    }

    void writesToNobodyUnlessToAll()
    {
        const Outcome silent = m_bus->dxl(u"write 1,3 led=on");
        QCOMPARE(silent.code, 1);
        QVERIFY2(silent.err.contains(u"nothing was written, since not everybody answered"), qPrintable(silent.err));
        // 300 mA is a register of the first model alone.
        const Outcome unknown = m_bus->dxl(u"write 1,4 led=on goal_current=300mA");
        QCOMPARE(unknown.code, 2);
        QVERIFY2(isOneSentence(unknown.err) && unknown.err.contains(u"ID 4"), qPrintable(unknown.err));
        const Outcome same = m_bus->dxl(u"write 1,2 led=on ID=9");
        QCOMPARE(same.code, 2);
        QVERIFY2(same.err.contains(u"the same ID"), qPrintable(same.err));
        m_bus->set(2, 57600, u"Torque Enable", 1);
        const Outcome locked = m_bus->dxl(u"write 1,2 led=on return_delay_time=0");
        QCOMPARE(locked.code, 1);
        for (const int id : {1, 2, 4})
            QCOMPARE(m_bus->value(id, 57600, u"LED"), 0);
    }

    void movesSeveralToAnotherRate()
    {
        const Outcome outcome = m_bus->dxl(u"write 1,2 baud_rate=1000000bps led=on");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QCOMPARE(m_bus->dxl(u"--baud 1000000 ping 1,2").code, 0);
        QCOMPARE(m_bus->value(2, 1000000, u"LED"), 1);
    }

    void torqueAndLed()
    {
        const Outcome on = m_bus->dxl(u"torque on 1,2,4");
        QCOMPARE(on.err, QString());
        QCOMPARE(on.out,
                 u"ID 1: Torque Enable = 1 (On)\nID 2: Torque Enable = 1 (On)\nID 4: Torque Enable = 1 (On)\n"_s);
        QCOMPARE(instructions(Instruction::SyncWrite), 1); // all at once
        QCOMPARE(
            m_bus->dxl(u"--json torque off 2").out,
            u"{\"id\":2,\"field\":\"Torque Enable\",\"address\":64,\"raw\":0,\"value\":0,\"unit\":\"\",\"meaning\":"
            u"\"Off\"}\n"_s);
        QCOMPARE(m_bus->value(1, 57600, u"Torque Enable"), 1);
        QCOMPARE(m_bus->value(2, 57600, u"Torque Enable"), 0);
        QCOMPARE(m_bus->dxl(u"led on 4").out, u"LED = 1 (On)\n"_s);
        QCOMPARE(m_bus->value(4, 57600, u"LED"), 1);
    }

    void torqueOffTellsWhoAnswers()
    {
        for (const int id : {1, 2})
            m_bus->set(id, 57600, u"Torque Enable", 1);
        const Outcome on = m_bus->dxl(u"torque on 3,4"); // nobody moves where somebody is missing
        QCOMPARE(on.code, 1);
        QCOMPARE(m_bus->value(4, 57600, u"Torque Enable"), 0);
        const Outcome off = m_bus->dxl(u"torque off 1-3");
        QCOMPARE(off.code, 1);
        for (const int id : {1, 2})
            QCOMPARE(m_bus->value(id, 57600, u"Torque Enable"), 0);
    }

    void torqueOfAMuteDevice()
    {
        m_bus->set(1, 57600, u"Status Return Level", 0);
        m_bus->set(1, 57600, u"Torque Enable", 1);
        const Outcome outcome = m_bus->dxl(u"torque off 1,2");
        QCOMPARE(outcome.code, 3);
        QVERIFY2(outcome.err.contains(u"ID 1: Torque Enable: sent, but not confirmed"), qPrintable(outcome.err));
        QCOMPARE(outcome.out, u"ID 2: Torque Enable = 0 (Off)\n"_s);
        QCOMPARE(m_bus->value(1, 57600, u"Torque Enable"), 0);
    }

    void info()
    {
        m_bus->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setHardwareError(0x24); });
        const Outcome text = m_bus->dxl(u"info 1");
        QCOMPARE(text.err, QString());
        QCOMPARE(text.code, 0);
        const QStringList lines = text.out.split(u'\n');
        QCOMPARE(lines[0], u"ID 1: XM430-W350 (model 1020), firmware 45, alert: see Hardware Error Status"_s);
        for (const QString &line :
             {u"  Series                 X"_s, u"  Baud rate              57600 bps"_s,
              u"  Operating Mode         Position control"_s, u"  Hardware Error Status  Overheating, Overload"_s,
              u"  Present Position       180.00 °"_s, u"  Return Delay Time      500 µs"_s})
            QVERIFY2(lines.contains(line), qPrintable(line + u'\n' + text.out));

        const QJsonObject document = QJsonDocument::fromJson(m_bus->dxl(u"--json info 1").out.toUtf8()).object();
        QCOMPARE(document[u"model_number"].toInt(), 1020);
        QCOMPARE(document[u"series"].toString(), u"X"_s);
        QCOMPARE(document[u"alert"].toBool(), true);
        const QJsonArray registers = document[u"registers"].toArray();
        const auto error = std::find_if(registers.begin(), registers.end(), [](const QJsonValue &one) {
            return one[u"field"].toString() == u"Hardware Error Status";
        });
        QVERIFY(error != registers.end());
        QCOMPARE((*error)[u"meaning"].toString(), u"Overheating, Overload"_s);
    }

    /// As in the window: bytes, with what the models numbered beside it suggest.
    void tableOfAnUnknownModel()
    {
        const QTemporaryDir tables;
        QFile file(tables.filePath(u"own.json"_s));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("{\"format\": 2, \"extends\": \"xl430\", \"models\": {\"Own\": {\"number\": 1065}}}");
        file.close();
        m_bus = std::make_unique<DxlBus>(u"Own@57600:4"_s, tables.path());
        QVERIFY(!m_bus->path().isEmpty());
        const Outcome text = m_bus->dxl(u"table 4");
        QCOMPARE(text.err, QString());
        const QStringList lines = text.out.trimmed().split(u'\n');
        QCOMPARE(lines[0], u"unknown model 1065 (ID 4), firmware 45"_s);
        QVERIFY2(lines[1].startsWith(u"Nothing is known of this model"), qPrintable(lines[1]));
        QCOMPARE(lines[2].simplified(), u"Address Size Access Name Raw Value"_s);
        QCOMPARE(lines[3].simplified(), u"0 1 ? Byte 0 (Model Number?) 41"_s);
        QCOMPARE(lines[10].simplified(), u"7 1 ? Byte 7 (ID?) 4"_s);
        const QJsonObject document = QJsonDocument::fromJson(m_bus->dxl(u"--json table 4").out.toUtf8()).object();
        QCOMPARE(document[u"model"].toString(), u"unknown model 1065"_s);
        const QJsonObject id = document[u"registers"][7].toObject();
        QCOMPARE(id[u"raw"].toInt(), 4);
        QCOMPARE(id[u"suggested"].toString(), u"ID"_s);
    }

    void table()
    {
        m_bus->set(4, 57600, u"LED", 1);
        const Outcome text = m_bus->dxl(u"table 4");
        QCOMPARE(text.err, QString());
        const QStringList lines = text.out.trimmed().split(u'\n');
        QCOMPARE(lines[0], u"XL430-W250 (ID 4), firmware 45"_s);
        QCOMPARE(lines[1].simplified(), u"Address Size Access Name Raw Value"_s);
        QCOMPARE(lines[2], u"EEPROM"_s);
        QVERIFY(lines.contains(u"RAM"));
        const auto row = [&](const QString &name) {
            const auto found = std::ranges::find_if(lines, [&](const QString &line) { return line.contains(name); });
            return found == lines.end() ? QString() : *found;
        };
        QCOMPARE(row(u" LED "_s).simplified(), u"65 1 RW LED 1 * On"_s);
        QCOMPARE(row(u" Baud Rate "_s).simplified(), u"8 1 RW Baud Rate 1 57600 bps"_s);
        QCOMPARE(row(u" Present Position "_s).simplified(), u"132 4 R Present Position 2048 180.00 °"_s);
        QCOMPARE(row(u" LED "_s).indexOf(u"LED"), row(u" Baud Rate "_s).indexOf(u"Baud")); // columns
        QCOMPARE(row(u" LED "_s).indexOf(u" On"), row(u" Baud Rate "_s).indexOf(u" 57600"));
        // Every register is there.
        const ControlTablePtr known = m_bus->catalog().find(1060, 45);
        QCOMPARE(static_cast<std::size_t>(lines.size()), known->fields().size() + 4);

        const QJsonObject document = QJsonDocument::fromJson(m_bus->dxl(u"--json table 4").out.toUtf8()).object();
        QCOMPARE(static_cast<std::size_t>(document[u"registers"].toArray().size()), known->fields().size());
        QCOMPARE(document[u"registers"][0].toObject(), QJsonObject({{u"id"_s, 4},
                                                                    {u"field"_s, u"Model Number"_s},
                                                                    {u"address"_s, 0},
                                                                    {u"raw"_s, 1060},
                                                                    {u"value"_s, 1060},
                                                                    {u"unit"_s, QString()},
                                                                    {u"size"_s, 2},
                                                                    {u"area"_s, u"EEPROM"_s},
                                                                    {u"access"_s, u"R"_s},
                                                                    {u"initial"_s, 1060}}));
    }

    void timeoutIsWaitedFor()
    {
        const Outcome outcome = test::dxl({u"--port"_s, m_bus->path(), u"--timeout"_s, u"321"_s, u"ping"_s, u"9"_s});
        QCOMPARE(outcome.code, 1);
        QVERIFY2(outcome.err.contains(u"nothing was received within 32"), qPrintable(outcome.err));
    }

    void verboseDecodes()
    {
        const Outcome outcome = m_bus->dxl(u"-v read 1 132:4");
        QVERIFY2(outcome.err.contains(u" > FF FF FD 00 01 07 00 02 84 00 04 00 1D 15  Read, ID 1: 4 bytes at 132\n"),
                 qPrintable(outcome.err));
        QVERIFY2(outcome.err.contains(u"  Status, ID 1: no error, 132 = 00 08 00 00\n"), qPrintable(outcome.err));
        QVERIFY(m_bus->dxl(u"-v read 1 2000:1").err.contains(u"Status, ID 1: Access Error (7)\n"));
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

DYNASCOPE_CORE_TEST(TestDxlMany)
#include "tst_dxlmany.moc"
