// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/bus.h"
#include "core/bus/messages.h"
#include "tests/support/fakeline.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

#include <QRegularExpression>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

const Bytes Position{0xA6, 0, 0, 0};

Bytes position(std::uint8_t id)
{
    return oracle::status(id, 0, Position);
}

Bytes firstBytes(const Bytes &bytes, int count)
{
    return {bytes.begin(), bytes.begin() + count};
}

Bytes damaged(Bytes bytes)
{
    bytes[9] ^= 0x20;
    return bytes;
}

Bytes join(std::initializer_list<Bytes> parts)
{
    Bytes all;
    for (const Bytes &part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

Request readPosition(std::uint8_t id = 3)
{
    return readRequest({id, 132, 4});
}

Request syncRead(const std::vector<std::uint8_t> &ids, bool fast = false)
{
    return syncReadRequest(132, 4, ids, fast);
}

QString toText(const Result<Reply> &reply)
{
    return reply ? QStringLiteral("%1: %2%3").arg(reply->id).arg(hex::text(reply->data), reply->alert ? QStringLiteral(" alert") : QString())
                 : reply.error().text;
}

/// How long was waited in vain is for other tests to say.
QString untimed(QString text)
{
    return text.replace(QRegularExpression(QStringLiteral("within [0-9.]+ m?s")), QStringLiteral("in time"));
}

QStringList toText(const Result<ExchangeResult> &result)
{
    if (!result)
        return {result.error().text};
    QStringList lines;
    for (const Result<Reply> &reply : result->replies)
        lines << untimed(toText(reply));
    return lines;
}

FakeLine::Answer inOrder(std::initializer_list<Bytes> packets)
{
    FakeLine::Answer pieces;
    LineTime at = 500us;
    for (const Bytes &packet : packets) {
        pieces.push_back({at, packet});
        at += static_cast<LineTime::rep>(packet.size()) * 10us + 500us;
    }
    return pieces;
}

} // namespace

class TestBus : public QObject
{
    Q_OBJECT

private slots:
    void oneAnswer_data()
    {
        QTest::addColumn<Bytes>("wire");
        QTest::addColumn<QString>("said");
        QTest::addColumn<int>("kind");
        const auto row = [](const char *name, const Bytes &wire, const QString &said, int kind = -1) {
            QTest::newRow(name) << wire << said << kind;
        };
        const auto bad = [](ErrorKind kind) { return static_cast<int>(kind); };
        row("good", position(3), QStringLiteral("3: A6 00 00 00"));
        row("alert rides beside the value", oracle::status(3, 0x80, Position), QStringLiteral("3: A6 00 00 00 alert"));
        row("noise first", join({{0, 0xFF, 7}, position(3)}), QStringLiteral("3: A6 00 00 00"));
        row("another ID first", join({position(4), position(3)}), QStringLiteral("3: A6 00 00 00"));
        row("a damaged one first", join({damaged(position(3)), position(3)}), QStringLiteral("3: A6 00 00 00"));
        row("a late one of another length first", join({oracle::status(3, 0, {1}), position(3)}), QStringLiteral("3: A6 00 00 00"));
        row("nothing", {}, QStringLiteral("device 3 did not answer: nothing was received in time"), bad(ErrorKind::NothingReceived));
        row("noise only", {1, 2, 3}, QStringLiteral("device 3 did not answer: 3 bytes came, but no packet began in them (noise, or "
                                                    "somebody at another baud rate)"), bad(ErrorKind::NoHeader));
        row("cut off", firstBytes(position(3), 7), QStringLiteral("the answer of device 3 was cut off after 7 of 15 bytes"), bad(ErrorKind::CutOff));
        row("cut off before its length", firstBytes(position(3), 5), QStringLiteral("the answer of device 3 was cut off after 5 bytes"), bad(ErrorKind::CutOff));
        row("damaged", damaged(position(3)), QStringLiteral("the answer of device 3 came damaged: its CRC is wrong"), bad(ErrorKind::DamagedCrc));
        row("another ID only", position(5), QStringLiteral("device 3 did not answer, but device 5 did"), bad(ErrorKind::WrongId));
        row("other IDs only", join({position(5), position(9)}), QStringLiteral("device 3 did not answer, but devices 5, 9 did"), bad(ErrorKind::WrongId));
        row("shorter", oracle::status(3, 0, {1}), QStringLiteral("device 3 answered with 1 byte where 4 were asked for"), bad(ErrorKind::WrongLength));
        row("longer", oracle::status(3, 0, {1, 2, 3, 4, 5}), QStringLiteral("device 3 answered with 5 bytes where 4 were asked for"), bad(ErrorKind::WrongLength));
        row("refused", oracle::status(3, 7, {}), QStringLiteral("device 3 refused: Access Error, the register is read-only, locked "
                                                                "while torque is on, or not in its table"), bad(ErrorKind::Refused));
        row("refused with data", oracle::status(3, 0x84, Position), QStringLiteral("device 3 refused: Data Range Error, the value is outside the register's range"), bad(ErrorKind::Refused));
        row("only the echo", encode(readPosition().packet), QStringLiteral("device 3 did not answer: nothing was received in time"), bad(ErrorKind::NothingReceived));
        row("a status with LEN 3", hex::bytes("FF FF FD 00 03 03 00 55 00 00"), QStringLiteral("device 3 did not answer: 10 bytes came, but no packet "
                                                  "began in them (noise, or somebody at another baud rate)"), bad(ErrorKind::NoHeader));
    }

    void oneAnswer()
    {
        QFETCH(Bytes, wire);
        QFETCH(QString, said);
        QFETCH(int, kind);
        FakeLine line;
        line.answer(wire);
        Bus bus(line);
        const auto result = bus.exchange(readPosition(), 0);
        QVERIFY(result);
        QCOMPARE(toText(result), QStringList(said));
        if (kind >= 0)
            QCOMPARE(static_cast<int>(result->replies.front().error().kind), kind);
        QVERIFY(line.now() < 10ms);
    }

    void refusalCarriesItsNumber()
    {
        FakeLine line;
        line.answer(oracle::status(3, 0x86, {}));
        Bus bus(line);
        QCOMPARE(bus.exchange(readPosition())->replies.front().error().number, std::uint8_t(6));
        QCOMPARE(line.sent.size(), std::size_t(1)); // what was refused is not asked again
    }

    // The clock starts when the last byte has left: at 9600 baud a long packet takes a quarter of a second.
    void deadlineCountsFromTheEndOfTheRequest()
    {
        FakeLine line(9600);
        line.answer(oracle::status(1, 0, {}), 400us);
        Bus bus(line);
        const Request request = writeRequest({1, 168, Bytes(230, 7)});
        QVERIFY(bus.exchange(request, 0)->replies.front());
        QVERIFY(line.now() > 250ms);
    }

    void deadlineKnowsReturnDelayAndHost()
    {
        FakeLine line;
        line.allowance = 20ms;
        line.answer(position(3), 20ms + 400us);
        Bus bus(line);
        QVERIFY(bus.exchange(readPosition(), 0)->replies.front());

        FakeLine quick;
        Bus quickBus(quick);
        Traits traits;
        traits.id = 3;
        traits.returnDelay = 0us;
        quickBus.setTraits({traits});
        quick.silence();
        QVERIFY(!quickBus.exchange(readPosition(), 0)->replies.front());
        QVERIFY(quick.now() < 400us); // 14 bytes, 0.1 ms
    }

    void writesMayTakeTheirTime()
    {
        FakeLine line;
        line.answer(oracle::status(3, 0, {}), 40ms);
        Bus bus(line);
        QVERIFY(bus.exchange(writeRequest({3, 7, {4}}), 0)->replies.front());
    }

    void retriesWhatBearsIt()
    {
        FakeLine line;
        line.answer(damaged(position(3))); // then a Ping as fence, then the read again
        line.answer(oracle::status(3, 0, {6, 4, 38})).answer(position(3));
        Bus bus(line);
        const auto result = bus.exchange(readPosition());
        QCOMPARE(toText(result), QStringList(QStringLiteral("3: A6 00 00 00")));
        QCOMPARE(result->seen.retries, 1);
        QCOMPARE(bus.statistics().retries, quint64(1));
        QCOMPARE(bus.statistics().crcErrors, quint64(1));

        FakeLine once;
        Bus onceBus(once);
        QVERIFY(!onceBus.exchange(rebootRequest(3))->replies.front());
        QCOMPARE(once.sent.size(), std::size_t(1));
    }

    // The worst fault a client can have: taking the old answer for the new value.
    void aLateAnswerIsNeverTakenForTheNextOne()
    {
        for (LineTime late = 1ms; late < 60ms; late += 137us) {
            FakeLine line;
            line.handler = [&](const Bytes &request) -> FakeLine::Answer {
                if (request[7] == 1)
                    return {{500us, oracle::status(3, 0, {6, 4, 38})}};
                const std::uint8_t value = request[8];
                return {{line.sent.size() == 1 ? late : LineTime(500us), oracle::status(3, 0, {value, 0, 0, 0})}};
            };
            Bus bus(line);
            (void)bus.exchange(readRequest({3, 132, 4}), 0);
            const auto second = bus.exchange(readRequest({3, 116, 4}), 2);
            if (second->replies.front())
                QCOMPARE(second->replies.front()->data[0], std::uint8_t(116));
        }
    }

    // An adapter that delays everything keeps the order: behind the answered Ping nothing older can come.
    void aDelayingAdapterIsFenced()
    {
        FakeLine line;
        line.allowance = 2ms;
        LineTime delay = 30ms;
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            const LineTime now = std::exchange(delay, LineTime(1ms));
            if (request[7] == 1)
                return {{now, oracle::status(3, 0, {6, 4, 38})}};
            return {{now, oracle::status(3, 0, {request[8], 0, 0, 0})}};
        };
        Bus bus(line);
        QVERIFY(!bus.exchange(readRequest({3, 132, 4}), 0)->replies.front());
        int wrong = 0;
        for (int i = 0; i < 20; ++i) {
            const auto result = bus.exchange(readRequest({3, 116, 4}), 2);
            if (result->replies.front() && result->replies.front()->data[0] != 116)
                ++wrong;
        }
        QCOMPARE(wrong, 0);
    }

    void echoIsStripped()
    {
        FakeLine line;
        line.echo = true;
        Bus bus(line);
        line.answer(position(3));
        const auto result = bus.exchange(readPosition(), 0);
        QCOMPARE(toText(result), QStringList(QStringLiteral("3: A6 00 00 00")));
        QVERIFY(result->seen.echo);
        QCOMPARE(result->seen.strayPackets, 0);
        // A client that believed the echo would find a device at every ID.
        QVERIFY(!bus.exchange(pingRequest(9), 0)->replies.front());
        // And what nobody answers still echoes; that must not disturb the next exchange.
        const std::vector<SpanData> writes{{1, 64, {0}}, {2, 64, {0}}};
        QVERIFY(bus.exchange(syncWriteRequest(writes)));
        line.answer(oracle::status(3, 0, {6, 4, 38})).answer(position(3));
        QCOMPARE(toText(bus.exchange(readPosition(), 0)), QStringList(QStringLiteral("3: A6 00 00 00")));
    }

    void groupRead_data()
    {
        QTest::addColumn<QList<Bytes>>("packets");
        QTest::addColumn<QStringList>("said");
        QTest::addColumn<int>("broken");
        const QString ok1 = QStringLiteral("1: A6 00 00 00"), ok2 = QStringLiteral("2: A6 00 00 00"), ok3 = QStringLiteral("3: A6 00 00 00");
        QTest::newRow("all") << QList<Bytes>{position(1), position(2), position(3)} << QStringList{ok1, ok2, ok3} << -1;
        QTest::newRow("last missing") << QList<Bytes>{position(1), position(2)}
            << QStringList{ok1, ok2, QStringLiteral("device 3 did not answer: nothing was received in time")} << 2;
        QTest::newRow("second missing") << QList<Bytes>{position(1)}
            << QStringList{ok1, QStringLiteral("device 2 did not answer: nothing was received in time"),
                           QStringLiteral("device 3 was not heard: device 2, asked before it, did not finish its answer")} << 1;
        QTest::newRow("first missing") << QList<Bytes>{}
            << QStringList{QStringLiteral("device 1 did not answer: nothing was received in time"),
                           QStringLiteral("device 2 was not heard: device 1, asked before it, did not finish its answer"),
                           QStringLiteral("device 3 was not heard: device 1, asked before it, did not finish its answer")} << 0;
        QTest::newRow("second damaged") << QList<Bytes>{position(1), damaged(position(2)), position(3)}
            << QStringList{ok1, QStringLiteral("the answer of device 2 came damaged: its CRC is wrong"), ok3} << -1;
        QTest::newRow("second cut off") << QList<Bytes>{position(1), firstBytes(position(2), 9)}
            << QStringList{ok1, QStringLiteral("the answer of device 2 was cut off after 9 of 15 bytes"),
                           QStringLiteral("device 3 was not heard: device 2, asked before it, did not finish its answer")} << 1;
        QTest::newRow("second of another length") << QList<Bytes>{position(1), oracle::status(2, 0, {1, 2}), position(3)}
            << QStringList{ok1, QStringLiteral("device 2 answered with 2 bytes where 4 were asked for"), ok3} << -1;
        QTest::newRow("second refuses") << QList<Bytes>{position(1), oracle::status(2, 7, {}), position(3)}
            << QStringList{ok1, QStringLiteral("device 2 refused: Access Error, the register is read-only, locked while torque is on, or not in its table"), ok3} << -1;
        QTest::newRow("second silent, third bold") << QList<Bytes>{position(1), position(3)}
            << QStringList{ok1, QStringLiteral("device 2 did not answer: nothing was received in time"), ok3} << -1;
    }

    void groupRead()
    {
        QFETCH(QList<Bytes>, packets);
        QFETCH(QStringList, said);
        QFETCH(int, broken);
        FakeLine line;
        FakeLine::Answer pieces;
        LineTime at = 500us;
        for (const Bytes &packet : packets) {
            pieces.push_back({at, packet});
            at += static_cast<LineTime::rep>(packet.size()) * 10us + 500us;
        }
        line.answer(pieces);
        Bus bus(line);
        const auto result = bus.exchange(syncRead({1, 2, 3}), 0);
        QCOMPARE(toText(result), said);
        QCOMPARE(result->brokenAt, broken);
    }

    void theSilentOneGoesLastWhenAskedAgain()
    {
        FakeLine line;
        line.answer(inOrder({position(1)}));
        line.answer(oracle::status(3, 0, {6, 4, 38})); // fence, by the first that is asked now
        line.answer(inOrder({position(3)}));
        Bus bus(line);
        const auto result = bus.exchange(syncRead({1, 2, 3}), 1);
        QCOMPARE(toText(result)[0], QStringLiteral("1: A6 00 00 00"));
        QCOMPARE(toText(result)[2], QStringLiteral("3: A6 00 00 00"));
        QVERIFY(!result->replies[1]);
        QCOMPARE(hex::text(line.sent.back().bytes), hex::text(encode(syncRead({3, 2}).packet)));
    }

    void fastReplyIsSalvaged_data()
    {
        QTest::addColumn<int>("keep");
        QTest::addColumn<int>("flip");
        QTest::addColumn<int>("good");
        QTest::newRow("whole") << 32 << -1 << 3;
        QTest::newRow("nothing") << 0 << -1 << 0;
        QTest::newRow("header only") << 8 << -1 << 0;
        QTest::newRow("cut in the second") << 20 << -1 << 1;
        QTest::newRow("cut before the last byte") << 31 << -1 << 2;
        QTest::newRow("damaged in the first") << 32 << 11 << 0;
        QTest::newRow("damaged in the third") << 32 << 27 << 2;
        QTest::newRow("damaged length") << 32 << 5 << 0;
    }

    void fastReplyIsSalvaged()
    {
        QFETCH(int, keep);
        QFETCH(int, flip);
        QFETCH(int, good);
        Bytes wire = hex::bytes("FF FF FD 00 FE 19 00 55 00 03 A6 00 00 00 84 08 00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00 D1 9E");
        if (flip >= 0)
            wire[static_cast<std::size_t>(flip)] ^= 0x02;
        FakeLine line;
        line.answer(firstBytes(wire, keep));
        Bus bus(line);
        const auto result = bus.exchange(syncRead({3, 7, 4}, true), 0);
        QCOMPARE(result->replies.size(), std::size_t(3));
        const std::array<Bytes, 3> values{Bytes{0xA6, 0, 0, 0}, Bytes{0x1F, 8, 0, 0}, Bytes{0xFF, 3, 0, 0}};
        for (int i = 0; i < 3; ++i) {
            const auto &reply = result->replies[static_cast<std::size_t>(i)];
            QCOMPARE(reply.has_value(), i < good);
            if (reply)
                QCOMPARE(reply->data, values[static_cast<std::size_t>(i)]);
        }
        QCOMPARE(result->brokenAt, good == 3 ? -1 : good);
    }

    void silenceByStatusReturnLevel()
    {
        Traits traits;
        traits.id = 3;
        traits.statusReturnLevel = 1;
        FakeLine line;
        Bus bus(line);
        bus.setTraits({traits});
        const auto written = bus.exchange(writeRequest({3, 64, {1}}));
        QVERIFY(written->replies.front());
        QCOMPARE(line.sent.size(), std::size_t(1));
        QVERIFY(line.now() < 5ms);
        QVERIFY(!bus.exchange(readPosition(), 0)->replies.front());
        traits.statusReturnLevel = 0;
        bus.setTraits({traits});
        QCOMPARE(toText(bus.exchange(readPosition(), 0)), // a fence, answered; then silence
                 QStringList(QStringLiteral("device 3 did not answer: nothing was received in time")));
        line.answer(oracle::status(3, 0, {6, 4, 38})).silence();
        QCOMPARE(toText(bus.exchange(readPosition(), 0)),
                 QStringList(QStringLiteral("device 3 did not answer: its Status Return Level 0 lets it answer only Ping")));
    }

    void broadcastPingFindsAll()
    {
        FakeLine line;
        line.answer(FakeLine::Answer{{0ms, oracle::status(0, 0, {6, 4, 38})},
                                     {21ms, oracle::status(7, 0x80, {0xFC, 3, 45})},
                                     {740ms, oracle::status(250, 0, {6, 4, 38})}});
        Bus bus(line);
        std::vector<std::pair<int, LineTime>> found;
        const auto result = bus.broadcastPing(252, [&](const Reply &reply) { found.emplace_back(reply.id, line.now()); });
        QVERIFY(result);
        QCOMPARE(result->replies.size(), std::size_t(3));
        QCOMPARE(found.size(), std::size_t(3));
        QVERIFY(found[0].second < 2ms); // as they come
        QVERIFY(line.now() >= 753ms && line.now() < 800ms);
        QVERIFY(result->replies[1]->alert);
    }

    void broadcastPingWaitsOnlyForTheIdsWanted()
    {
        FakeLine line;
        Bus bus(line);
        QVERIFY(bus.broadcastPing(9, {}));
        QVERIFY(line.now() >= 30ms && line.now() < 32ms);
    }

    void broadcastPingIsCancelledWithinASlot()
    {
        FakeLine line;
        std::atomic<bool> cancel = false;
        line.answer(oracle::status(1, 0, {6, 4, 38}), 3ms);
        Bus bus(line);
        bus.setCancel(&cancel);
        const auto result = bus.broadcastPing(252, [&](const Reply &) { cancel = true; });
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::Cancelled);
        QVERIFY(line.now() < 7ms);
    }

    void stopEndsAnExchangeAtOnce()
    {
        FakeLine line;
        line.allowance = 500ms;
        std::atomic<bool> stop = false;
        Bus bus(line, &stop);
        line.handler = [&](const Bytes &) -> FakeLine::Answer {
            stop = true;
            return {};
        };
        const auto result = bus.exchange(readPosition());
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::Stopped);
        QVERIFY(line.now() < 3ms);
        QCOMPARE(bus.exchange(readPosition()).error().kind, ErrorKind::Stopped);
        QCOMPARE(line.sent.size(), std::size_t(1));
        QVERIFY(bus.sendOnly(encode(pingRequest(1).packet))); // STOP's own way
        QCOMPARE(line.sent.size(), std::size_t(2));
    }

    void aLostPortEndsEverything()
    {
        FakeLine line;
        Bus bus(line);
        line.unplugged = true;
        QCOMPARE(bus.exchange(readPosition()).error().kind, ErrorKind::PortLost);
        QVERIFY(bus.lost());
    }

    void babblingLineEnds()
    {
        FakeLine line;
        for (int i = 0; i < 100'000; ++i)
            line.babble(i * 10us, {static_cast<std::uint8_t>(i % 3 == 0 ? 0xFD : 0xFF)});
        Bus bus(line);
        QVERIFY(bus.exchange(readPosition(), 0));
        QVERIFY(line.now() < 100ms);
    }

    void baudChangeDrainsFirst()
    {
        FakeLine line(9600);
        Bus bus(line);
        const Bytes packet = encode(pingRequest(1).packet);
        QVERIFY(line.write(packet)); // as if just sent
        QVERIFY(bus.sendOnly(packet));
        const LineTime sent = line.now();
        QVERIFY(bus.setBaudRate(1'000'000));
        QCOMPARE(line.baudRate(), 1'000'000);
        QVERIFY(line.now() >= sent + 20us);
        line.refusedBaud = 57600;
        QVERIFY(!bus.setBaudRate(57600));
        QCOMPARE(line.baudRate(), 1'000'000);
    }

    void tooLongIsRefused()
    {
        FakeLine line;
        Bus bus(line);
        const auto result = bus.exchange(writeRequest({1, 0, Bytes(1020, 1)}));
        QVERIFY(!result);
        QCOMPARE(result.error().kind, ErrorKind::InvalidArgument);
        QVERIFY(line.sent.empty());
    }

    void countsAndTaps()
    {
        FakeLine line;
        line.answer(join({{1, 2}, position(4), position(3)}));
        Bus bus(line);
        QStringList seen;
        bus.setTap([&](Bus::Direction direction, LineTime, ByteView bytes) {
            seen << (direction == Bus::Direction::Sent ? QStringLiteral("> ") : QStringLiteral("< ")) + hex::text(bytes);
        });
        QVERIFY(bus.exchange(readPosition()));
        QCOMPARE(seen, (QStringList{QStringLiteral("> FF FF FD 00 03 07 00 02 84 00 04 00 ") + seen[0].right(5),
                                    QStringLiteral("< ") + hex::text(position(4)), QStringLiteral("< ") + hex::text(position(3))}));
        const BusStatistics statistics = bus.statistics();
        QCOMPARE(statistics.exchanges, quint64(1));
        QCOMPARE(statistics.replies, quint64(1));
        QCOMPARE(statistics.strays, quint64(1));
        QCOMPARE(statistics.bytesSent, quint64(14));
        QCOMPARE(statistics.bytesReceived, quint64(32));
        QVERIFY(statistics.busy > 500us);
    }
};

DYNASCOPE_CORE_TEST(TestBus)
#include "tst_bus.moc"
