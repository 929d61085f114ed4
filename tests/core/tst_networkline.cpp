// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/networkline.h"
#include "tests/support/hex.h"
#include "tests/support/loopbackserver.h"
#include "tests/support/testmain.h"

#include <thread>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

const std::atomic<bool> Never = false;

std::unique_ptr<NetworkLine> opened(const QString &name, int baudRate = 57600)
{
    auto line = NetworkLine::open(name, baudRate, {}, Never);
    if (!line)
        qFatal("%s", qPrintable(line.error().text));
    return std::move(*line);
}

Error errorOf(const QString &name, const NetworkOptions &options = {}, const std::atomic<bool> &cancel = Never)
{
    auto line = NetworkLine::open(name, 57600, options, cancel);
    return line ? Error{} : line.error();
}

/// One whole subnegotiation "set the rate", and the purge behind it.
const Bytes EndOfRateRequest = hex::bytes("FF FA 2C 0C 01 FF F0");

Bytes rateConfirmed(int rate)
{
    Bytes bytes = hex::bytes("FF FA 2C 65");
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::uint8_t>(rate >> shift)); // those used here hold no FF
    const Bytes end = hex::bytes("FF F0");
    bytes.insert(bytes.end(), end.begin(), end.end());
    return bytes;
}

/// A line through RFC 2217, and what the server heard until it was open.
struct Controlled {
    explicit Controlled(int baudRate = 57600)
    {
        std::thread serving([&] {
            server.accept();
            server.write(hex::bytes("FF FD 2C FF FB 00 FF FD 00"));
            heard = server.readUntil(EndOfRateRequest);
            server.write(rateConfirmed(baudRate));
        });
        line = opened(server.address(QStringLiteral("rfc2217")), baudRate);
        serving.join();
    }

    LoopbackServer server;
    std::unique_ptr<NetworkLine> line;
    Bytes heard;
};

} // namespace

class TestNetworkLine : public QObject
{
    Q_OBJECT

private slots:
    void writesAndReadsRawBytes_data()
    {
        QTest::addColumn<bool>("ipv6");
        QTest::newRow("IPv4") << false;
        if (LoopbackServer::hasIpv6())
            QTest::newRow("IPv6") << true;
    }
    void writesAndReadsRawBytes()
    {
        QFETCH(bool, ipv6);
        LoopbackServer server(ipv6);
        const QString name = server.address(QStringLiteral("tcp"));
        const auto line = opened(name, 1'000'000);
        server.accept();
        QCOMPARE(line->name(), name);
        QCOMPARE(line->baudRate(), 1'000'000);
        QVERIFY(!line->canSetBaudRate());
        const Bytes packet = hex::bytes("FF FF FD 00 01 03 00 01 19 4E");
        QVERIFY(line->write(packet));
        QCOMPARE(hex::text(server.read(packet.size())), hex::text(packet));
        server.write(packet);
        Bytes got{0x42};
        while (got.size() < packet.size() + 1)
            QVERIFY(line->read(got, line->now() + 5s));
        QCOMPARE(hex::text(got), QStringLiteral("42 ") + hex::text(packet));
    }

    void theRateIsTheServers()
    {
        LoopbackServer server;
        const auto line = opened(server.address(QStringLiteral("tcp")) + QStringLiteral("?baud=1000000"));
        server.accept();
        QCOMPARE(line->baudRate(), 1'000'000);
        QCOMPARE(line->byteTime(), LineTime(10us));
        const Result<void> set = line->setBaudRate(57600);
        QVERIFY(!set);
        QCOMPARE(set.error().kind, ErrorKind::PortUnsuitable);
        QVERIFY2(set.error().text.contains(QStringLiteral("the rate is the server's")), qPrintable(set.error().text));
        QCOMPARE(line->baudRate(), 1'000'000);
        QVERIFY(line->write(Bytes{7}));
        QCOMPARE(server.read(1), Bytes{7}); // the refusal sent nothing
    }

    void waitsUntilTheDeadlineAndNoLonger()
    {
        LoopbackServer server;
        const auto line = opened(server.address(QStringLiteral("tcp")));
        server.accept();
        for (const LineTime wait : {LineTime(300us), LineTime(2ms), LineTime(7ms)}) {
            const LineTime deadline = line->now() + wait;
            Bytes got;
            QVERIFY(line->read(got, deadline));
            QVERIFY(got.empty());
            QVERIFY(line->now() >= deadline);
        }
        server.write({1});
        Bytes got;
        while (got.empty()) // the past: what is there, without waiting
            QVERIFY(line->read(got, LineTime(0)));
        QCOMPARE(got, Bytes{1});
    }

    void discardsInput()
    {
        LoopbackServer server;
        const auto line = opened(server.address(QStringLiteral("tcp")));
        server.accept();
        server.write({1, 2, 3});
        Bytes got;
        QVERIFY(line->read(got, line->now() + 5s));
        server.write(Bytes(20'000, 4));
        line->discardInput(); // what has come by now: all of it within a few tries
        for (got = {9}; !got.empty();) {
            got.clear();
            QVERIFY(line->read(got, line->now() + 50ms));
            line->discardInput();
        }
        server.write({5});
        QVERIFY(line->read(got, line->now() + 5s));
        QCOMPARE(got, Bytes{5});
    }

    void aLostConnectionIsALostPort()
    {
        LoopbackServer server;
        const auto line = opened(server.address(QStringLiteral("tcp")));
        server.accept();
        server.write({1, 2});
        server.hangUp();
        Bytes got;
        Result<void> result;
        for (int i = 0; i < 10 && result; ++i)
            result = line->read(got, line->now() + 5s);
        QCOMPARE(got, (Bytes{1, 2})); // what came before is not lost
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::PortLost);
        QVERIFY(result.error().text.startsWith(QStringLiteral("the connection to tcp://127.0.0.1:")));
        QCOMPARE(line->read(got, line->now() + 5s).error().kind, ErrorKind::PortLost);
        QCOMPARE(line->write(Bytes{1}).error().kind, ErrorKind::PortLost);
        line->discardInput();
    }

    void saysWhyItCanNotConnect()
    {
        const QString nobody = QStringLiteral("tcp://127.0.0.1:%1").arg(LoopbackServer::freePort());
        QCOMPARE(errorOf(nobody).kind, ErrorKind::PortNotFound);
        QVERIFY(errorOf(nobody).text.startsWith(nobody + QStringLiteral(" refused the connection")));
        QCOMPARE(errorOf(QStringLiteral("tcp://127.0.0.1:0")).kind, ErrorKind::PortUnsuitable);
        // RFC 6761: this name never exists; without a network no name server says so.
        const Error unknown = errorOf(QStringLiteral("tcp://nowhere.invalid:4000"));
        QCOMPARE(unknown.kind, ErrorKind::PortNotFound);
        QVERIFY2(unknown.text.contains(QStringLiteral("nowhere.invalid")), qPrintable(unknown.text));
    }

    void saysThatAServerHungUpAtOnce_data()
    {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<Bytes>("words");
        QTest::addColumn<QString>("quoted");
        const QByteArray text("Port already\r\nin\x1b use\r\n");
        const QString quoted = QStringLiteral("(\"Port already in use\")");
        QTest::newRow("raw") << QStringLiteral("tcp") << Bytes(text.begin(), text.end()) << quoted;
        QTest::newRow("RFC 2217") << QStringLiteral("rfc2217") << Bytes(text.begin(), text.end()) << quoted;
        QTest::newRow("silently") << QStringLiteral("tcp") << Bytes() << QStringLiteral("at once: is its");
        QTest::newRow("with a flood") << QStringLiteral("rfc2217") << Bytes(300'000, 0x41)
                                      << QStringLiteral("(\"%1\")").arg(QString(80, u'A'));
    }
    void saysThatAServerHungUpAtOnce()
    {
        QFETCH(QString, scheme);
        QFETCH(Bytes, words);
        QFETCH(QString, quoted);
        LoopbackServer server;
        std::thread serving([&] {
            server.accept();
            (void)server.read(scheme == QLatin1String("tcp") ? 0 : 15);
            server.write(words);
            server.hangUp();
        });
        const Error error = errorOf(server.address(scheme));
        serving.join();
        QCOMPARE(error.kind, ErrorKind::PortBusy);
        QVERIFY2(error.text.contains(quoted), qPrintable(error.text));
    }

    void givesUpWhenTold()
    {
        LoopbackServer server; // takes the connection and says nothing
        const std::atomic<bool> cancel = true;
        QCOMPARE(errorOf(server.address(QStringLiteral("rfc2217")), {}, cancel).kind, ErrorKind::Cancelled);
        QCOMPARE(errorOf(server.address(QStringLiteral("tcp")), {}, cancel).kind, ErrorKind::Cancelled);
        QCOMPARE(errorOf(QStringLiteral("tcp://nowhere.invalid:4000"), {1h, {}}, cancel).kind, ErrorKind::Cancelled);
    }

    void givesUpAfterTheLimit()
    {
        NetworkOptions hasty;
        hasty.connectLimit = 1ns;
        const Error error = errorOf(QStringLiteral("tcp://nowhere.invalid:4000"), hasty);
        QCOMPARE(error.kind, ErrorKind::PortNotFound);
    }

    void agreesOnItsPort()
    {
        Controlled wire(1'000'000);
        QVERIFY(wire.line->canSetBaudRate());
        QCOMPARE(wire.line->baudRate(), 1'000'000);
        const QString said = hex::text(wire.heard);
        QVERIFY2(said.startsWith(QStringLiteral("FF FB 2C ")), qPrintable(said));          // WILL COM-PORT-OPTION
        QVERIFY2(said.contains(QStringLiteral("FF FA 2C 02 08 FF F0")), qPrintable(said)); // 8 data bits
        QVERIFY2(said.contains(QStringLiteral("FF FA 2C 01 00 0F 42 40 FF F0")), qPrintable(said));
    }

    void doublesFF()
    {
        Controlled wire;
        QVERIFY(wire.line->write(hex::bytes("FF FF FD 00 01")));
        QCOMPARE(hex::text(wire.server.read(7)), QStringLiteral("FF FF FF FF FD 00 01"));
        wire.server.write(hex::bytes("FF FA 2C 6B 00 FF F0 FF FF FF FF FD 00 02 FF F1"));
        Bytes got;
        while (got.size() < 5)
            QVERIFY(wire.line->read(got, wire.line->now() + 5s));
        QCOMPARE(hex::text(got), QStringLiteral("FF FF FD 00 02"));
    }

    void telnetsOwnWordsAreNoData()
    {
        Controlled wire;
        wire.server.write(hex::bytes("FF F1 FF FD 18 42"));
        Bytes got;
        QVERIFY(wire.line->read(got, wire.line->now() + 5s));
        QCOMPARE(hex::text(got), QStringLiteral("42"));
        QCOMPARE(hex::text(wire.server.read(3)), QStringLiteral("FF FC 18"));
    }

    void setsARate_data()
    {
        QTest::addColumn<int>("made");
        QTest::addColumn<bool>("fine");
        QTest::newRow("as asked") << 1'000'000 << true;
        QTest::newRow("3 % off") << 970'000 << true;
        QTest::newRow("more off") << 960'000 << false;
        QTest::newRow("stays as it is") << 57600 << false;
    }
    void setsARate()
    {
        QFETCH(int, made);
        QFETCH(bool, fine);
        Controlled wire;
        Bytes again;
        std::thread serving([&] {
            (void)wire.server.readUntil(EndOfRateRequest);
            wire.server.write({0x11, 0x22}); // of the old rate
            wire.server.write(rateConfirmed(made));
            if (!fine) {
                again = wire.server.readUntil(EndOfRateRequest);
                wire.server.write(rateConfirmed(57600));
            }
        });
        const Result<void> set = wire.line->setBaudRate(1'000'000);
        serving.join();
        QCOMPARE(set.has_value(), fine);
        QCOMPARE(wire.line->baudRate(), fine ? 1'000'000 : 57600);
        if (!fine) {
            QCOMPARE(set.error().kind, ErrorKind::PortUnsuitable);
            QVERIFY(
                hex::text(again).startsWith(QStringLiteral("FF FA 2C 01 00 00 E1 00 FF F0"))); // back to the old one
        }
        wire.line->discardInput();
        wire.server.write({0x33});
        Bytes got;
        QVERIFY(wire.line->read(got, wire.line->now() + 5s));
        QCOMPARE(hex::text(got), QStringLiteral("33"));
        QVERIFY(!wire.line->setBaudRate(0)); // no request for the server's rate
    }

    void aRateThatIsNotConfirmedEndsTheConnection()
    {
        Controlled wire;
        const Result<void> set = wire.line->setBaudRate(1'000'000);
        QVERIFY(!set);
        QCOMPARE(set.error().kind, ErrorKind::PortLost);
        QVERIFY2(set.error().text.contains(QStringLiteral("did not confirm 1000000 baud")),
                 qPrintable(set.error().text));
        QCOMPARE(wire.line->write(Bytes{1}).error(), set.error()); // nothing goes out at a rate nobody knows
    }

    void givesUpWaitingForARate()
    {
        LoopbackServer server;
        std::atomic<bool> cancel = false;
        std::thread serving([&] {
            server.accept();
            server.write(hex::bytes("FF FD 2C FF FB 00 FF FD 00"));
            (void)server.readUntil(EndOfRateRequest);
            cancel = true; // and no word on the rate
        });
        const Error error = errorOf(server.address(QStringLiteral("rfc2217")), {}, cancel);
        serving.join();
        QCOMPARE(error.kind, ErrorKind::Cancelled);
    }

    void whoReadsNothingIsLostSoon()
    {
        LoopbackServer server;
        const auto line = opened(server.address(QStringLiteral("tcp")));
        server.accept();
        const Bytes much(1'000'000, 7);
        LineTime begin{};
        Result<void> written;
        for (int i = 0; i < 100 && written; ++i) {
            begin = line->now();
            written = line->write(much);
        }
        QVERIFY(!written);
        QCOMPARE(written.error().kind, ErrorKind::PortLost);
        QVERIFY2(line->now() - begin < 1500ms, "STOP waits as long");
    }

    void aServerThatKnowsNoRfc2217()
    {
        LoopbackServer server;
        std::thread serving([&] {
            server.accept();
            server.write(hex::bytes("FF FE 2C"));
            (void)server.read(1000); // until the client leaves
        });
        const Error error = errorOf(server.address(QStringLiteral("rfc2217")));
        serving.join();
        QCOMPARE(error.kind, ErrorKind::PortUnsuitable);
        QVERIFY2(error.text.contains(QStringLiteral("open it as tcp://")), qPrintable(error.text));
    }

    void aServerThatNeverStops()
    {
        Controlled wire;
        std::atomic<bool> done = false;
        std::thread flood([&] {
            Bytes commands;
            for (int i = 0; i < 1000; ++i)
                commands.insert(commands.end(), {0xFF, 0xF1}); // NOP: no data ever
            while (!done)
                wire.server.write(commands);
        });
        for (int i = 0; i < 20; ++i) {
            const LineTime deadline = wire.line->now() + 2ms;
            Bytes got;
            QVERIFY(wire.line->read(got, deadline));
            QVERIFY(got.empty());
        }
        wire.line->discardInput(); // comes back
        const Result<void> set = wire.line->setBaudRate(1'000'000);
        QCOMPARE(set.error().kind, ErrorKind::PortLost);
        done = true;
        flood.join();
    }

    void knowsItsNames()
    {
        NetworkLineFactory factory;
        QVERIFY(factory.knows(QStringLiteral("tcp://host:4000")));
        QVERIFY(factory.knows(QStringLiteral("rfc2217://nonsense")));
        QVERIFY(!factory.knows(QStringLiteral("/dev/ttyUSB0")));
        LoopbackServer server;
        QVERIFY(factory.open(server.address(QStringLiteral("tcp")), 57600));
        QVERIFY(!factory.open(QStringLiteral("tcp://host"), 57600));
    }
};

DYNASCOPE_CORE_TEST(TestNetworkLine)
#include "tst_networkline.moc"
