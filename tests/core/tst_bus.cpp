// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exchangetext.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace exchangetext;
using namespace std::chrono_literals;

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
        row("a late one of another length first", join({oracle::status(3, 0, {1}), position(3)}),
            QStringLiteral("3: A6 00 00 00"));
        row("nothing", {}, QStringLiteral("device 3 did not answer: nothing was received in time"),
            bad(ErrorKind::NothingReceived));
        row("noise only", {1, 2, 3},
            QStringLiteral("device 3 did not answer: 3 bytes came, but no packet began in them (noise, or "
                           "somebody at another baud rate)"),
            bad(ErrorKind::NoHeader));
        row("cut off", firstBytes(position(3), 7),
            QStringLiteral("the answer of device 3 was cut off after 7 of 15 bytes"), bad(ErrorKind::CutOff));
        row("cut off before its length", firstBytes(position(3), 5),
            QStringLiteral("the answer of device 3 was cut off after 5 bytes"), bad(ErrorKind::CutOff));
        row("damaged", damaged(position(3)), QStringLiteral("the answer of device 3 came damaged: its CRC is wrong"),
            bad(ErrorKind::DamagedCrc));
        row("another ID only", position(5), QStringLiteral("device 3 did not answer, but device 5 did"),
            bad(ErrorKind::WrongId));
        row("other IDs only", join({position(5), position(9)}),
            QStringLiteral("device 3 did not answer, but devices 5, 9 did"), bad(ErrorKind::WrongId));
        row("shorter", oracle::status(3, 0, {1}),
            QStringLiteral("device 3 answered with 1 byte where 4 were asked for"), bad(ErrorKind::WrongLength));
        row("longer", oracle::status(3, 0, {1, 2, 3, 4, 5}),
            QStringLiteral("device 3 answered with 5 bytes where 4 were asked for"), bad(ErrorKind::WrongLength));
        row("refused", oracle::status(3, 7, {}),
            QStringLiteral("device 3 refused: Access Error, the register is read-only, locked "
                           "while torque is on, or not in its table"),
            bad(ErrorKind::Refused));
        row("refused with data", oracle::status(3, 0x84, Position),
            QStringLiteral("device 3 refused: Data Range Error, the value is outside the register's range"),
            bad(ErrorKind::Refused));
        row("only the echo", encode(readPosition().packet),
            QStringLiteral("device 3 did not answer: nothing was received in time"), bad(ErrorKind::NothingReceived));
        row("a status with LEN 3", hex::bytes("FF FF FD 00 03 03 00 55 00 00"),
            QStringLiteral("device 3 did not answer: 10 bytes came, but no packet "
                           "began in them (noise, or somebody at another baud rate)"),
            bad(ErrorKind::NoHeader));
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

    void whatWasNotSentIsSaidSo()
    {
        FakeLine line;
        Bus bus(line);
        QVERIFY(!bus.exchange(readPosition(), 0)->replies.front());
        const auto reboot = bus.exchange(rebootRequest(3));
        QCOMPARE(reboot->replies.front().error().kind, ErrorKind::NotSent);
        for (const FakeLine::Sent &sent : line.sent)
            QVERIFY(sent.bytes[7] != static_cast<std::uint8_t>(Instruction::Reboot));
    }

    // Another controller reads the same device: its answer is not ours.
    void aForeignAnswerIsNotOurs()
    {
        FakeLine line;
        line.answer(join({encode(readRequest({3, 116, 4}).packet), oracle::status(3, 0, {1, 2, 3, 4}), position(3)}));
        Bus bus(line);
        const auto result = bus.exchange(readPosition(), 0);
        QVERIFY(!result->replies.front());
        QCOMPARE(result->replies.front().error().kind, ErrorKind::LateAnswer);
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
        line.answer(position(3));
        QCOMPARE(toText(bus.exchange(readPosition(), 0)), QStringList(QStringLiteral("3: A6 00 00 00")));
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
            seen << (direction == Bus::Direction::Sent ? QStringLiteral("> ") : QStringLiteral("< "))
                    + hex::text(bytes);
        });
        QVERIFY(bus.exchange(readPosition()));
        QCOMPARE(seen,
            (QStringList{QStringLiteral("> FF FF FD 00 03 07 00 02 84 00 04 00 ") + seen[0].right(5),
                QStringLiteral("< ") + hex::text(position(4)), QStringLiteral("< ") + hex::text(position(3))}));
        const BusStatistics statistics = bus.statistics();
        QCOMPARE(statistics.exchanges, quint64(1));
        QCOMPARE(statistics.replies, quint64(1));
        QCOMPARE(statistics.strays, quint64(1));
        QCOMPARE(statistics.bytesSent, quint64(14));
        QCOMPARE(statistics.bytesReceived, quint64(32));
        QCOMPARE(statistics.busy, 46 * line.byteTime());
    }
};

DYNASCOPE_CORE_TEST(TestBus)
#include "tst_bus.moc"
