// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dxlprocess.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <memory>

using namespace Qt::StringLiterals;
using dynascope::test::Outcome;
using dynascope::test::SimProcess;

namespace {

QJsonDocument json(const Outcome &outcome)
{
    return QJsonDocument::fromJson(outcome.out.toUtf8());
}

/// One sentence: a line that begins with the program's name and ends there.
bool isOneSentence(const QString &text)
{
    return text.startsWith(u"dxl: ") && text.count(u'\n') == 1 && text.endsWith(u'\n');
}

} // namespace

/// `dxl` against `dxl sim`, over a pseudo-terminal. Each test function has a bus of its own.
class TestDxl : public QObject
{
    Q_OBJECT

private slots:
    void init();
    void cleanup() { m_sim.reset(); }

    void ping();
    void silenceOffersAScan();
    void scan();
    void scanInJson();
    void scanOfNobody();
    void scanOfASharedId_data();
    void scanOfASharedId();
    void read_data();
    void read();
    void readInJson();
    void readsOnInAList();
    void write();
    void writeByAddress();
    void refusesBeforeWriting_data();
    void refusesBeforeWriting();
    void saysWhyTheDeviceRefused();
    void unitFollowsDriveMode();
    void changesId();
    void keepsOffATakenId();
    void changesBaudRate();
    void followsChangesByAddress_data();
    void followsChangesByAddress();
    void changesPlaceAlone();
    void saysWhatWasWritten();
    void silentByStatusReturnLevel();
    void muteDevice();
    void muteDeviceKeepsItsPlace();
    void showsPackets();

private:
    Outcome dxl(const QStringList &arguments) const { return m_sim->dxl(arguments); }
    QString readBack(const QString &field) const { return dxl({u"read"_s, u"1"_s, field}).out.trimmed(); }

    std::unique_ptr<SimProcess> m_sim;
};

void TestDxl::init()
{
    m_sim = std::make_unique<SimProcess>(u"XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288/52@1000000:7"_s);
    QVERIFY2(!m_sim->path().isEmpty(), qPrintable(m_sim->errors()));
}

void TestDxl::ping()
{
    const Outcome text = dxl({u"ping"_s, u"1"_s});
    QCOMPARE(text.err, QString());
    QCOMPARE(text.out, u"ID 1: XM430-W350 (model 1020), firmware 45\n"_s);
    QCOMPARE(text.code, 0);

    const Outcome document = dxl({u"--baud"_s, u"1000000"_s, u"--json"_s, u"ping"_s, u"7"_s});
    QCOMPARE(document.out,
             u"{\"id\":7,\"model\":\"XL330-M288\",\"model_number\":1200,\"firmware\":52,\"alert\":false}\n"_s);
    QCOMPARE(document.code, 0);
}

void TestDxl::silenceOffersAScan()
{
    for (const QStringList &command : {QStringList{u"ping"_s, u"3"_s}, QStringList{u"read"_s, u"3"_s, u"132:4"_s},
                                       QStringList{u"read"_s, u"3"_s, u"Torque Enable"_s},
                                       QStringList{u"write"_s, u"3"_s, u"64:1=0"_s}}) {
        const Outcome outcome = dxl(command);
        QCOMPARE(outcome.code, 1);
        QCOMPARE(outcome.out, QString());
        QVERIFY2(isOneSentence(outcome.err), qPrintable(outcome.err));
        QVERIFY2(outcome.err.contains(u"nothing was received within"), qPrintable(outcome.err));
        QVERIFY2(outcome.err.contains(u"57600 bps"), qPrintable(outcome.err));
        QVERIFY2(outcome.err.contains(u"scan --bauds all"), qPrintable(outcome.err));
    }
}

void TestDxl::scan()
{
    const Outcome here = dxl({u"scan"_s, u"--ids"_s, u"0-10"_s});
    QCOMPARE(here.err, QString());
    QCOMPARE(here.out, u"57600 bps, ID 1: XM430-W350 (model 1020), firmware 45\n"
                       u"57600 bps, ID 2: XL430-W250 (model 1060), firmware 45\n"_s);
    QCOMPARE(here.code, 0);

    QCOMPARE(dxl({u"scan"_s, u"--ids"_s, u"0-3"_s, u"--sweep"_s}).out, here.out); // one by one, the same

    const Outcome everywhere = dxl({u"scan"_s, u"--bauds"_s, u"all"_s, u"--ids"_s, u"2-10"_s});
    QCOMPARE(everywhere.out, u"57600 bps, ID 2: XL430-W250 (model 1060), firmware 45\n"
                             u"1000000 bps, ID 7: XL330-M288 (model 1200), firmware 52\n"_s);
    QCOMPARE(everywhere.code, 0);
}

void TestDxl::scanInJson()
{
    const Outcome outcome = dxl({u"scan"_s, u"--json"_s, u"--bauds"_s, u"1000000,57600"_s, u"--ids"_s, u"0-10"_s});
    QCOMPARE(outcome.code, 0);
    const QJsonArray devices = json(outcome).array();
    QCOMPARE(devices.size(), 3);
    QCOMPARE(devices[0].toObject(), QJsonObject({{u"id"_s, 7}, {u"baud"_s, 1000000}, {u"model"_s, u"XL330-M288"_s},
                                                 {u"model_number"_s, 1200}, {u"firmware"_s, 52}, {u"alert"_s, false}}));
    QCOMPARE(devices[1].toObject()[u"id"], 1);
    QCOMPARE(devices[2].toObject()[u"id"], 2);
}

void TestDxl::scanOfNobody()
{
    const Outcome here = dxl({u"--json"_s, u"--baud"_s, u"115200"_s, u"scan"_s, u"--ids"_s, u"0-3"_s});
    QCOMPARE(here.code, 0);
    QCOMPARE(here.out, u"[]\n"_s);
    QVERIFY2(isOneSentence(here.err), qPrintable(here.err));
    QVERIFY2(here.err.contains(u"nobody answered at 115200 bps"), qPrintable(here.err));
    QVERIFY2(here.err.contains(u"scan --bauds all"), qPrintable(here.err));
}

void TestDxl::scanOfASharedId_data()
{
    QTest::addColumn<QString>("servos");
    QTest::newRow("two models") << u"XM430-W350@57600:4,XL430-W250@57600:4"_s;
    QTest::newRow("two alike") << u"XM430-W350@57600:4,XM430-W350@57600:4"_s;
}

void TestDxl::scanOfASharedId()
{
    QFETCH(QString, servos);
    m_sim = std::make_unique<SimProcess>(servos);
    const Outcome outcome = dxl({u"--json"_s, u"scan"_s, u"--ids"_s, u"0-5"_s});
    QCOMPARE(outcome.code, 0);
    const QJsonArray devices = json(outcome).array();
    QVERIFY(!devices.isEmpty());
    for (const QJsonValue &device : devices)
        QVERIFY2(device[u"doubt"].toString().contains(u"share ID 4"), qPrintable(outcome.out));
}

void TestDxl::read_data()
{
    QTest::addColumn<QString>("asked");
    QTest::addColumn<QString>("line");
    QTest::newRow("number") << u"Model Number"_s << u"Model Number = 1020"_s;
    QTest::newRow("any case") << u"MODEL_number"_s << u"Model Number = 1020"_s;
    QTest::newRow("dashes") << u"model-number"_s << u"Model Number = 1020"_s;
    QTest::newRow("no spaces") << u"modelnumber"_s << u"Model Number = 1020"_s;
    QTest::newRow("degrees") << u"present position"_s << u"Present Position = 2048 (180.00 °)"_s;
    QTest::newRow("enum") << u"operating mode"_s << u"Operating Mode = 3 (Position control)"_s;
    QTest::newRow("bits") << u"shutdown"_s << u"Shutdown = 52 (Overheating, Electrical shock, Overload)"_s;
    QTest::newRow("time") << u"return delay time"_s << u"Return Delay Time = 250 (500 µs)"_s;
    QTest::newRow("address, 4 bytes") << u"132:4"_s << u"132:4 = 2048 (0x00000800)"_s;
    QTest::newRow("address, hexadecimal") << u"0x84:2"_s << u"132:2 = 2048 (0x0800)"_s;
    QTest::newRow("address, 1 byte") << u"9:1"_s << u"9:1 = 250 (0xfa)"_s;
    QTest::newRow("address, more") << u"0:7"_s << u"0:7 = fc 03 00 00 00 00 2d"_s;
}

void TestDxl::read()
{
    QFETCH(QString, asked);
    QFETCH(QString, line);
    const Outcome outcome = dxl({u"read"_s, u"1"_s, asked});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, line + u'\n');
    QCOMPARE(outcome.code, 0);
}

void TestDxl::readInJson()
{
    const Outcome one = dxl({u"--json"_s, u"read"_s, u"1"_s, u"present-position"_s});
    QCOMPARE(one.out, u"{\"id\":1,\"field\":\"Present Position\",\"address\":132,\"raw\":2048,\"value\":180.0,"
                      u"\"unit\":\"deg\"}\n"_s);

    const Outcome several = dxl({u"--json"_s, u"read"_s, u"1"_s, u"Operating Mode"_s, u"132:4"_s, u"0:7"_s});
    QCOMPARE(several.code, 0);
    const QJsonArray list = json(several).array();
    QCOMPARE(list.size(), 3);
    QCOMPARE(list[0].toObject(), QJsonObject({{u"id"_s, 1}, {u"field"_s, u"Operating Mode"_s}, {u"address"_s, 11},
                                              {u"raw"_s, 3}, {u"value"_s, 3}, {u"unit"_s, QString()},
                                              {u"meaning"_s, u"Position control"_s}}));
    QCOMPARE(list[1].toObject(),
             QJsonObject({{u"id"_s, 1}, {u"address"_s, 132}, {u"length"_s, 4}, {u"raw"_s, 2048}}));
    QCOMPARE(list[2].toObject(),
             QJsonObject({{u"id"_s, 1}, {u"address"_s, 0}, {u"length"_s, 7}, {u"hex"_s, u"fc03000000002d"_s}}));
}

void TestDxl::readsOnInAList()
{
    const Outcome outcome = dxl({u"--json"_s, u"read"_s, u"1"_s, u"2000:4"_s, u"Model Number"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"Access Error"), qPrintable(outcome.err));
    const QJsonArray list = json(outcome).array();
    QCOMPARE(list.size(), 2);
    QVERIFY(list[0].toObject()[u"error"].toString().contains(u"Access Error"));
    QCOMPARE(list[1].toObject()[u"raw"], 1020);
}

void TestDxl::write()
{
    const Outcome outcome =
        dxl({u"write"_s, u"1"_s, u"drive_mode=0"_s, u"torque_enable=on"_s, u"Goal Position=90deg"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"Drive Mode = 0 (None)\nTorque Enable = 1 (On)\nGoal Position = 1024 (90.00 °)\n"_s);
    QCOMPARE(outcome.code, 0);

    const auto position = [this] {
        return json(dxl({u"--json"_s, u"read"_s, u"1"_s, u"132:4"_s})).object()[u"raw"].toInt();
    };
    QTRY_VERIFY_WITH_TIMEOUT(qAbs(position() - 1024) < 20, 20'000); // it moves there

    const Outcome raw = dxl({u"--json"_s, u"write"_s, u"1"_s, u"goal_position=0x800"_s});
    QCOMPARE(raw.out, u"{\"id\":1,\"field\":\"Goal Position\",\"address\":116,\"raw\":2048,\"value\":180.0,"
                      u"\"unit\":\"deg\"}\n"_s);
}

void TestDxl::writeByAddress()
{
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"20:4=-2"_s}).out, u"20:4 = 4294967294 (0xfffffffe)\n"_s);
    QCOMPARE(readBack(u"Homing Offset"_s), u"Homing Offset = -2 (-0.18 °)"_s);
    // Six Indirect Addresses' bytes at once.
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"168:6=E1 00 E2 00 E3 00"_s}).out, u"168:6 = e1 00 e2 00 e3 00\n"_s);
}

void TestDxl::refusesBeforeWriting_data()
{
    QTest::addColumn<QString>("assignment");
    QTest::addColumn<QString>("says");
    QTest::newRow("unknown field") << u"goal=1"_s << u"has no field \"goal\"; nearest: Goal PWM"_s;
    QTest::newRow("nonsense field") << u"xyzzy=1"_s << u"has no field \"xyzzy\""_s;
    QTest::newRow("read only") << u"present_position=1"_s << u"can only be read"_s;
    QTest::newRow("out of range") << u"goal_position=4096"_s << u"0 to 4095"_s;
    QTest::newRow("wrong unit") << u"goal_position=30rpm"_s << u"deg"_s;
    QTest::newRow("not a value") << u"goal_position=fast"_s << u"fast"_s;
    QTest::newRow("no value") << u"goal_position"_s << u"FIELD=VALUE"_s;
    QTest::newRow("empty value") << u"goal_position="_s << u"no value"_s;
    QTest::newRow("too large for its bytes") << u"64:1=256"_s << u"-128 to 255"_s;
    QTest::newRow("bytes missing") << u"168:6=0102"_s << u"12 hexadecimal digits"_s;
    QTest::newRow("no such place") << u"65536:1=1"_s << u"outside"_s;
    QTest::newRow("too long a place") << u"65535:2=1"_s << u"behind the last address"_s;
    QTest::newRow("no length") << u"64:0=1"_s << u"length"_s;
    QTest::newRow("baud rate as code") << u"baud_rate=57600"_s << u"write 57600bps or 1"_s;
}

void TestDxl::refusesBeforeWriting()
{
    QFETCH(QString, assignment);
    QFETCH(QString, says);
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"led=1"_s, assignment});
    QCOMPARE(outcome.code, 2);
    QCOMPARE(outcome.out, QString());
    QVERIFY2(isOneSentence(outcome.err), qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
    QCOMPARE(readBack(u"65:1"_s), u"65:1 = 0 (0x00)"_s); // the first assignment, LED, was not carried out either
}

void TestDxl::saysWhyTheDeviceRefused()
{
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"torque_enable=1"_s, u"return_delay_time=10us"_s, u"led=1"_s});
    QCOMPARE(outcome.code, 1);
    QCOMPARE(outcome.out, QString()); // the first assignment would lock the second: none is written
    QVERIFY2(isOneSentence(outcome.err), qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(u"Return Delay Time is in the EEPROM area"), qPrintable(outcome.err));
    QCOMPARE(readBack(u"64:1"_s), u"64:1 = 0 (0x00)"_s);
    QCOMPARE(readBack(u"9:1"_s), u"9:1 = 250 (0xfa)"_s);
    // Past the table nothing is known beforehand: the device itself refuses.
    const Outcome byAddress = dxl({u"write"_s, u"1"_s, u"torque_enable=1"_s, u"9:1=5"_s, u"led=1"_s});
    QCOMPARE(byAddress.code, 1);
    QCOMPARE(byAddress.out, u"Torque Enable = 1 (On)\n"_s);
    QVERIFY2(isOneSentence(byAddress.err), qPrintable(byAddress.err));
    QVERIFY2(byAddress.err.contains(u"Access Error") && byAddress.err.contains(u"torque"), qPrintable(byAddress.err));
    QCOMPARE(readBack(u"65:1"_s), u"65:1 = 0 (0x00)"_s); // what follows a failure is not written
}

void TestDxl::unitFollowsDriveMode()
{
    QVERIFY(readBack(u"Profile Velocity"_s).contains(u"rev/min"));
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"drive_mode=4"_s, u"profile_velocity=2s"_s}).code, 0);
    QVERIFY2(readBack(u"Profile Velocity"_s).startsWith(u"Profile Velocity = 2000 (2000 ms"),
             qPrintable(readBack(u"Profile Velocity"_s)));
}

void TestDxl::changesId()
{
    const Outcome outcome = dxl({u"--json"_s, u"write"_s, u"1"_s, u"ID=5"_s, u"led=on"_s});
    QCOMPARE(outcome.err, QString());
    const QJsonArray list = json(outcome).array();
    QCOMPARE(list.size(), 2);
    QCOMPARE(list[0].toObject()[u"raw"], 5);
    QCOMPARE(list[1].toObject()[u"id"], 5); // what follows goes to the new ID
    QCOMPARE(dxl({u"ping"_s, u"5"_s}).code, 0);
    QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 1);
}

void TestDxl::keepsOffATakenId()
{
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"ID=2"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"taken"), qPrintable(outcome.err));
    QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 0);
    QCOMPARE(dxl({u"ping"_s, u"2"_s}).code, 0);
}

void TestDxl::changesBaudRate()
{
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"baud_rate=3"_s, u"led=1"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"Baud Rate = 3 (1000000 bps)\nLED = 1 (On)\n"_s);
    QCOMPARE(dxl({u"--baud"_s, u"1000000"_s, u"ping"_s, u"1"_s}).code, 0);
    QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 1);
}

void TestDxl::followsChangesByAddress_data()
{
    QTest::addColumn<QStringList>("assignments");
    QTest::addColumn<QString>("printed");
    QTest::addColumn<QString>("baud");
    QTest::addColumn<QString>("id");
    QTest::newRow("ID") << QStringList{u"7:1=5"_s} << u"7:1 = 5 (0x05)\n"_s << u"57600"_s << u"5"_s;
    QTest::newRow("baud rate") << QStringList{u"8:1=3"_s} << u"8:1 = 3 (0x03)\n"_s << u"1000000"_s << u"1"_s;
    QTest::newRow("what follows goes there")
        << QStringList{u"7:1=5"_s, u"8:1=3"_s, u"led=on"_s}
        << u"7:1 = 5 (0x05)\n8:1 = 3 (0x03)\nLED = 1 (On)\n"_s << u"1000000"_s << u"5"_s;
}

void TestDxl::followsChangesByAddress()
{
    QFETCH(QStringList, assignments);
    QFETCH(QString, printed);
    QFETCH(QString, baud);
    QFETCH(QString, id);
    const Outcome outcome = dxl(QStringList{u"write"_s, u"1"_s} + assignments);
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, printed);
    QCOMPARE(outcome.code, 0);
    QCOMPARE(dxl({u"--baud"_s, baud, u"ping"_s, id}).code, 0);
}

void TestDxl::changesPlaceAlone()
{
    // Where a device is after several of its registers changed at once is not looked for.
    const Outcome refused = dxl({u"write"_s, u"1"_s, u"led=1"_s, u"7:2=0x0305"_s});
    QCOMPARE(refused.code, 2);
    QCOMPARE(refused.out, QString());
    QVERIFY2(isOneSentence(refused.err) && refused.err.contains(u"write 7:1 by itself"), qPrintable(refused.err));
    QCOMPARE(readBack(u"65:1"_s), u"65:1 = 0 (0x00)"_s);
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"7:3=01 01 FA"_s}).code, 2); // a number, as 1 to 4 bytes are
    const Outcome same = dxl({u"write"_s, u"1"_s, u"7:3=0xFA0101"_s});
    QCOMPARE(same.err, QString());
    QCOMPARE(same.code, 0);
}

void TestDxl::saysWhatWasWritten()
{
    const auto failing = [this](const QStringList &assignments) {
        const Outcome outcome = dxl(QStringList{u"write"_s, u"1"_s} + assignments);
        return isOneSentence(outcome.err) && outcome.code == 1 ? outcome.err.trimmed() : u"?"_s + outcome.err;
    };
    const QString alone = failing({u"2000:1=1"_s});
    QVERIFY2(!alone.contains(u"written"), qPrintable(alone));
    const QString first = failing({u"2000:1=1"_s, u"led=1"_s});
    QVERIFY2(first.endsWith(u"; nothing was written before it"), qPrintable(first));
    const QString third = failing({u"led=1"_s, u"Profile Velocity=5"_s, u"2000:1=1"_s, u"torque_enable=1"_s});
    QVERIFY2(third.endsWith(u"; written before it: led, Profile Velocity"), qPrintable(third));
}

void TestDxl::silentByStatusReturnLevel()
{
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"status_return_level=1"_s}).code, 0);
    QCOMPARE(dxl({u"write"_s, u"1"_s, u"led=1"_s}).out, u"LED = 1 (On)\n"_s);
}

void TestDxl::muteDevice()
{
    // At level 0 nothing can be read back: what was sent is not called done, nor failed.
    const Outcome last = dxl({u"write"_s, u"1"_s, u"led=1"_s, u"68:1=0"_s, u"led=0"_s});
    QCOMPARE(last.code, 3);
    QCOMPARE(last.out, u"LED = 1 (On)\n"_s); // before it fell silent
    QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 0);
    const Outcome read = dxl({u"read"_s, u"1"_s, u"led"_s});
    QCOMPARE(read.code, 1);
    QVERIFY2(isOneSentence(read.err) && read.err.contains(u"Status Return Level 0"), qPrintable(read.err));
    QVERIFY2(read.err.contains(u"write status_return_level=1 first"), qPrintable(read.err));

    const Outcome sent = dxl({u"write"_s, u"1"_s, u"led=1"_s, u"Profile Velocity=7"_s});
    QCOMPARE(sent.code, 3);
    QCOMPARE(sent.out, QString()); // what is printed has been read back
    QCOMPARE(sent.err.count(u"sent, but not confirmed: "), 2);
    const Outcome document = dxl({u"--json"_s, u"write"_s, u"1"_s, u"goal_pwm=5"_s});
    QCOMPARE(document.code, 3);
    QCOMPARE(document.out, u"{\"id\":1,\"field\":\"Goal PWM\",\"address\":100,\"sent\":5,\"confirmed\":false}\n"_s);

    const Outcome out = dxl({u"write"_s, u"1"_s, u"status_return_level=2"_s}); // the way out
    QCOMPARE(out.err, QString());
    QCOMPARE(out.code, 0);
    QCOMPARE(readBack(u"led"_s), u"LED = 1 (On)"_s);
    QCOMPARE(readBack(u"112:4"_s), u"112:4 = 7 (0x00000007)"_s);
}

void TestDxl::muteDeviceKeepsItsPlace()
{
    // Whether EEPROM is free and where the device is afterwards could not be seen.
    dxl({u"write"_s, u"1"_s, u"68:1=0"_s});
    for (const QString &assignment : {u"ID=5"_s, u"7:1=5"_s, u"8:1=3"_s, u"return_delay_time=0"_s}) {
        const Outcome refused = dxl({u"write"_s, u"1"_s, assignment});
        QCOMPARE(refused.code, 1);
        QVERIFY2(isOneSentence(refused.err), qPrintable(refused.err));
        QVERIFY2(refused.err.contains(u"write status_return_level=1 first"), qPrintable(refused.err));
        QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 0);
    }
}

void TestDxl::showsPackets()
{
    const Outcome outcome = dxl({u"-v"_s, u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 0);
    QVERIFY2(outcome.err.contains(u"> FF FF FD 00 01 03 00 01 19 4E"), qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(u"< FF FF FD 00 01 07 00 55 00 FC 03 2D"), qPrintable(outcome.err));
}

DYNASCOPE_CORE_TEST(TestDxl)
#include "tst_dxl.moc"
