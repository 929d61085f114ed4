// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/networklinefactory.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/dxlprocess.h"
#include "tests/support/loopbackserver.h"
#include "tests/support/ser2net.h"
#include "tests/support/testmain.h"

using namespace Qt::StringLiterals;
using namespace dynascope;
using test::Outcome;
using test::Ser2net;

namespace {

bool isOneSentence(const QString &text)
{
    return text.startsWith(u"dxl: ") && text.count(u'\n') == 1;
}

} // namespace

/// `dxl` through ser2net, in front of the simulated bus. The server's own rate is 57 600 bps.
class TestDxlSer2net : public QObject
{
    Q_OBJECT

private slots:
    void init();
    void cleanup();

    void reads_data() { kinds(); }
    void reads();
    void writes_data() { kinds(); }
    void writes();
    void scansOneRateOverTcp();
    void scansEveryRateThroughRfc2217();
    void changesABaudRateThroughRfc2217();
    void refusesABaudChangeOverTcp_data();
    void refusesABaudChangeOverTcp();
    void silenceOverTcp();
    void opensAtAnotherRateThroughRfc2217();
    void notRfc2217();
    void nobodyListens();
    void usedBySomebodyElse_data() { kinds(); }
    void usedBySomebodyElse();
    void noSerialPortBehindIt_data() { kinds(); }
    void noSerialPortBehindIt();

private:
    static void kinds();
    Outcome dxl(const QStringList &arguments) const
    {
        // A loaded machine may take its time: nobody is called silent for that.
        return test::dxl(QStringList{u"--port"_s, m_net->address(), u"--timeout"_s, u"400"_s} + arguments);
    }
    void serve(Ser2net::Kind kind) { m_net = std::make_unique<Ser2net>(m_server->path(), kind); }
    int writesOnTheWire();
    int baudCode();

    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<sim::PtyServer> m_server;
    std::unique_ptr<Ser2net> m_net;
};

void TestDxlSer2net::kinds()
{
    QTest::addColumn<int>("kind");
    QTest::newRow("tcp") << static_cast<int>(Ser2net::Kind::Raw);
    QTest::newRow("rfc2217") << static_cast<int>(Ser2net::Kind::Rfc2217);
}

void TestDxlSer2net::init()
{
    auto bus = std::make_unique<sim::SimulatedBus>(m_catalog);
    const auto specs =
        sim::parseServoSpecs(u"XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288/52@1000000:7"_s, m_catalog);
    QVERIFY(specs);
    for (const sim::ServoSpec &spec : *specs)
        QVERIFY(bus->add(spec));
    bus->setLogging(true);
    auto server = sim::PtyServer::start(std::move(bus));
    QVERIFY(server);
    m_server = std::move(*server);
}

void TestDxlSer2net::cleanup()
{
    m_net.reset();
    m_server.reset();
}

/// Packets with Write, Reg Write, Sync Write, Bulk Write or Factory Reset in them, as the servos' wire had them.
int TestDxlSer2net::writesOnTheWire()
{
    int count = 0;
    m_server->call([&count](sim::SimulatedBus &bus, LineTime) {
        for (const sim::WireEntry &entry : bus.log()) {
            const bool whole = entry.fromController && entry.bytes.size() > 7;
            const int instruction = whole ? entry.bytes[7] : 0;
            count += instruction == 0x03 || instruction == 0x04 || instruction == 0x06 || instruction == 0x83
                     || instruction == 0x93;
        }
    });
    return count;
}

int TestDxlSer2net::baudCode()
{
    int code = -1;
    m_server->call([&code](sim::SimulatedBus &bus, LineTime) {
        code = static_cast<int>(bus.servos().front()->value(u"Baud Rate"));
    });
    return code;
}

void TestDxlSer2net::reads()
{
    QFETCH(int, kind);
    serve(static_cast<Ser2net::Kind>(kind));
    const Outcome outcome = dxl({u"read"_s, u"1"_s, u"model_number"_s, u"132:4"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"Model Number = 1020\n132:4 = 2048 (0x00000800)\n"_s);
}

void TestDxlSer2net::writes()
{
    QFETCH(int, kind);
    serve(static_cast<Ser2net::Kind>(kind));
    // FF FF FF FF on the wire: stuffed by the protocol, doubled by Telnet.
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"homing_offset=-1"_s, u"torque_enable=on"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"Homing Offset = -1 (-0.09 °)\nTorque Enable = 1 (On)\n"_s);
    QCOMPARE(dxl({u"read"_s, u"1"_s, u"20:4"_s}).out, u"20:4 = 4294967295 (0xffffffff)\n"_s);
}

void TestDxlSer2net::scansOneRateOverTcp()
{
    serve(Ser2net::Kind::Raw);
    const Outcome outcome = dxl({u"scan"_s, u"--ids"_s, u"0-10"_s, u"--bauds"_s, u"all"_s});
    QCOMPARE(outcome.code, 0);
    QCOMPARE(outcome.out, u"57600 bps, ID 1: XM430-W350 (model 1020), firmware 45\n"
                          u"57600 bps, ID 2: XL430-W250 (model 1060), firmware 45\n"_s);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"the server's: only that one is scanned"),
             qPrintable(outcome.err));
}

void TestDxlSer2net::scansEveryRateThroughRfc2217()
{
    serve(Ser2net::Kind::Rfc2217);
    const Outcome outcome = dxl({u"scan"_s, u"--ids"_s, u"0-10"_s, u"--bauds"_s, u"57600,115200,1000000"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"57600 bps, ID 1: XM430-W350 (model 1020), firmware 45\n"
                          u"57600 bps, ID 2: XL430-W250 (model 1060), firmware 45\n"
                          u"1000000 bps, ID 7: XL330-M288 (model 1200), firmware 52\n"_s);
}

void TestDxlSer2net::changesABaudRateThroughRfc2217()
{
    serve(Ser2net::Kind::Rfc2217);
    const Outcome outcome = dxl({u"write"_s, u"1"_s, u"baud_rate=3"_s, u"led=1"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.out, u"Baud Rate = 3 (1000000 bps)\nLED = 1 (On)\n"_s);
    QCOMPARE(dxl({u"--baud"_s, u"1000000"_s, u"ping"_s, u"1"_s}).code, 0);
    QCOMPARE(dxl({u"ping"_s, u"1"_s}).code, 1);
}

void TestDxlSer2net::refusesABaudChangeOverTcp_data()
{
    QTest::addColumn<QString>("assignment");
    QTest::newRow("to another rate") << u"baud_rate=3"_s;
    QTest::newRow("by address") << u"8:1=3"_s;
    QTest::newRow("among other bytes") << u"7:3=0xFA0301"_s;
}

void TestDxlSer2net::refusesABaudChangeOverTcp()
{
    QFETCH(QString, assignment);
    serve(Ser2net::Kind::Raw);
    const Outcome outcome = dxl({u"write"_s, u"1"_s, assignment});
    QVERIFY(outcome.code != 0);
    QCOMPARE(outcome.out, QString());
    QVERIFY2(isOneSentence(outcome.err), qPrintable(outcome.err));
    QVERIFY2(outcome.err.contains(u"the server's"), qPrintable(outcome.err));
    QCOMPARE(writesOnTheWire(), 0);
    QCOMPARE(baudCode(), 1);
}

void TestDxlSer2net::silenceOverTcp()
{
    serve(Ser2net::Kind::Raw);
    const Outcome ping = dxl({u"ping"_s, u"7"_s}); // it listens at 1 M
    QCOMPARE(ping.code, 1);
    QVERIFY2(isOneSentence(ping.err) && ping.err.contains(u"the rate is the server's"), qPrintable(ping.err));
    QVERIFY2(!ping.err.contains(u"--bauds all"), qPrintable(ping.err));
    const Outcome scan = dxl({u"scan"_s, u"--ids"_s, u"3-9"_s});
    QCOMPARE(scan.code, 0);
    QVERIFY2(scan.err.contains(u"the server's rate") && !scan.err.contains(u"--bauds all"), qPrintable(scan.err));
}

void TestDxlSer2net::opensAtAnotherRateThroughRfc2217()
{
    serve(Ser2net::Kind::Rfc2217);
    const Outcome outcome = dxl({u"--baud"_s, u"1000000"_s, u"ping"_s, u"7"_s});
    QCOMPARE(outcome.err, QString());
    QCOMPARE(outcome.code, 0);
}

void TestDxlSer2net::notRfc2217()
{
    serve(Ser2net::Kind::Raw);
    QString name = m_net->address();
    name.replace(u"tcp://"_s, u"rfc2217://"_s);
    const Outcome outcome = test::dxl({u"--port"_s, name, u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"open it as tcp://"), qPrintable(outcome.err));
}

void TestDxlSer2net::nobodyListens()
{
    const QString name = u"tcp://127.0.0.1:%1"_s.arg(LoopbackServer::freePort());
    const Outcome outcome = test::dxl({u"--port"_s, name, u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"refused the connection"), qPrintable(outcome.err));
    const Outcome wrong = test::dxl({u"--port"_s, u"tcp://127.0.0.1"_s, u"ping"_s, u"1"_s});
    QCOMPARE(wrong.code, 1);
    QVERIFY2(isOneSentence(wrong.err) && wrong.err.contains(u"is no address"), qPrintable(wrong.err));
}

void TestDxlSer2net::usedBySomebodyElse()
{
    QFETCH(int, kind);
    serve(static_cast<Ser2net::Kind>(kind));
    const auto first = NetworkLineFactory().open(m_net->address(), 57600);
    QVERIFY2(first, first ? "" : qPrintable(first.error().text));
    const Outcome second = dxl({u"ping"_s, u"1"_s});
    QCOMPARE(second.code, 1);
    QVERIFY2(isOneSentence(second.err) && second.err.contains(u"ended the connection at once"), qPrintable(second.err));
}

void TestDxlSer2net::noSerialPortBehindIt()
{
    QFETCH(int, kind);
    serve(static_cast<Ser2net::Kind>(kind));
    m_server.reset(); // the adapter is unplugged, the server runs on
    const Outcome outcome = dxl({u"ping"_s, u"1"_s});
    QCOMPARE(outcome.code, 1);
    QVERIFY2(isOneSentence(outcome.err) && outcome.err.contains(u"ended the connection at once"),
             qPrintable(outcome.err));
}

DYNASCOPE_CORE_TEST(TestDxlSer2net)
#include "tst_dxlser2net.moc"
