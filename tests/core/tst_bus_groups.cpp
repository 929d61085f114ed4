// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exchangetext.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace exchangetext;
using namespace std::chrono_literals;

/// Exchanges that more than one device answers.
class TestBusGroups : public QObject
{
    Q_OBJECT

private slots:
    void groupRead_data()
    {
        QTest::addColumn<QList<Bytes>>("packets");
        QTest::addColumn<QStringList>("said");
        QTest::addColumn<int>("broken");
        const QString ok1 = QStringLiteral("1: A6 00 00 00"), ok2 = QStringLiteral("2: A6 00 00 00"),
                      ok3 = QStringLiteral("3: A6 00 00 00");
        QTest::newRow("all") << QList<Bytes>{position(1), position(2), position(3)} << QStringList{ok1, ok2, ok3} << -1;
        QTest::newRow("last missing") << QList<Bytes>{position(1), position(2)}
                                      << QStringList{ok1, ok2,
                                             QStringLiteral("device 3 did not answer: nothing was received in time")}
                                      << 2;
        QTest::newRow("second missing")
            << QList<Bytes>{position(1)}
            << QStringList{ok1, QStringLiteral("device 2 did not answer: nothing was received in time"),
                   QStringLiteral("device 3 was not heard: device 2, asked before it, did not finish its answer")}
            << 1;
        QTest::newRow("first missing")
            << QList<Bytes>{}
            << QStringList{QStringLiteral("device 1 did not answer: nothing was received in time"),
                   QStringLiteral("device 2 was not heard: device 1, asked before it, did not finish its answer"),
                   QStringLiteral("device 3 was not heard: device 1, asked before it, did not finish its answer")}
            << 0;
        QTest::newRow("second damaged") << QList<Bytes>{position(1), damaged(position(2)), position(3)}
                                        << QStringList{ok1,
                                               QStringLiteral("the answer of device 2 came damaged: its CRC is wrong"),
                                               ok3}
                                        << -1;
        QTest::newRow("second cut off")
            << QList<Bytes>{position(1), firstBytes(position(2), 9)}
            << QStringList{ok1, QStringLiteral("the answer of device 2 was cut off after 9 of 15 bytes"),
                   QStringLiteral("device 3 was not heard: device 2, asked before it, did not finish its answer")}
            << 1;
        QTest::newRow("second of another length")
            << QList<Bytes>{position(1), oracle::status(2, 0, {1, 2}), position(3)}
            << QStringList{ok1, QStringLiteral("device 2 answered with 2 bytes where 4 were asked for"), ok3} << -1;
        QTest::newRow("second refuses") << QList<Bytes>{position(1), oracle::status(2, 7, {}), position(3)}
                                        << QStringList{ok1,
                                               QStringLiteral(
                                                   "device 2 refused: Access Error, the register is read-only, locked "
                                                   "while torque is on, or not in its table"),
                                               ok3}
                                        << -1;
        QTest::newRow("second silent, third bold")
            << QList<Bytes>{position(1), position(3)}
            << QStringList{ok1, QStringLiteral("device 2 did not answer: nothing was received in time"), ok3} << -1;
    }

    void groupRead()
    {
        QFETCH(QList<Bytes>, packets);
        QFETCH(QStringList, said);
        QFETCH(int, broken);
        FakeLine line;
        line.answer(inOrder(packets));
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
        Bytes wire = hex::bytes(
            "FF FF FD 00 FE 19 00 55 00 03 A6 00 00 00 84 08 00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00 D1 9E");
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

    void broadcastPingFindsAll()
    {
        FakeLine line;
        line.answer(FakeLine::Answer{{0ms, oracle::status(0, 0, {6, 4, 38})},
            {21ms, oracle::status(7, 0x80, {0xFC, 3, 45})}, {740ms, oracle::status(250, 0, {6, 4, 38})}});
        Bus bus(line);
        std::vector<std::pair<int, LineTime>> found;
        const auto result =
            bus.broadcastPing(252, [&](const Reply &reply) { found.emplace_back(reply.id, line.now()); });
        QVERIFY(result);
        QCOMPARE(result->replies.size(), std::size_t(3));
        QCOMPARE(found.size(), std::size_t(3));
        QVERIFY(found[0].second < 2ms); // as they come
        QVERIFY(line.now() >= 750ms && line.now() < 760ms);
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
};

DYNASCOPE_CORE_TEST(TestBusGroups)
#include "tst_bus_groups.moc"
