// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exchangetext.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace exchangetext;
using namespace std::chrono_literals;

/// What the bus makes of what it is told of a device: above all whether it answers.
class TestBusTraits : public QObject
{
    Q_OBJECT

private slots:
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
        QCOMPARE(toText(bus.exchange(readPosition(), 0)),
            QStringList(QStringLiteral("device 3 did not answer: its Status Return Level 0 lets it answer only Ping")));
    }

    void traitsAreOfOneRate()
    {
        Traits here, there;
        here.id = there.id = 3;
        here.baudRate = 1'000'000;
        there.baudRate = 57600;
        there.statusReturnLevel = 1;
        FakeLine line;
        Bus bus(line);
        bus.setTraits({here, there});
        QCOMPARE(bus.traits(3), here);
        QVERIFY(bus.setBaudRate(57600));
        QCOMPARE(bus.traits(3), there);
        const LineTime begin = line.now();
        const auto cleared = bus.exchange(clearRequest(3, ClearOption::Position)); // takes up to 3 s
        QVERIFY(cleared->replies.front());
        QVERIFY(line.now() - begin < 20ms);
        QVERIFY(bus.setBaudRate(9600));
        QCOMPARE(bus.traits(3).statusReturnLevel, std::uint8_t(2));
    }

    // Its level was set by somebody else, say: it does answer, and late.
    void whatAMuteDeviceSaysIsNotTheNextWritesAnswer_data()
    {
        QTest::addColumn<int>("nextLevel");
        QTest::newRow("still believed mute") << 1;
        QTest::newRow("known to answer") << 2;
    }
    void whatAMuteDeviceSaysIsNotTheNextWritesAnswer()
    {
        QFETCH(int, nextLevel);
        constexpr std::uint8_t DataLimit = 6;
        for (LineTime late = 1ms; late < 40ms; late += 137us) {
            FakeLine line;
            line.handler = [&](const Bytes &request) -> FakeLine::Answer {
                if (request[7] == 1)
                    return {{500us, oracle::status(3, 0, {6, 4, 38})}};
                const bool first = line.sent.size() == 1;
                return {{first ? late : LineTime(500us), oracle::status(3, first ? DataLimit : 0, {})}};
            };
            Traits traits;
            traits.id = 3;
            traits.statusReturnLevel = 1;
            Bus bus(line);
            bus.setTraits({traits});
            (void)bus.exchange(writeRequest({3, 64, {9}}), 0);
            traits.statusReturnLevel = static_cast<std::uint8_t>(nextLevel);
            bus.setTraits({traits});
            const auto second = bus.exchange(writeRequest({3, 64, {1}}), 0);
            const Result<Reply> &reply = second->replies.front();
            QVERIFY2(reply || reply.error().kind != ErrorKind::Refused, qPrintable(QString::number(late.count())));
        }
    }

    // The same of a Read: its level is thought to be 0, and it answers, late.
    void whatASilentDeviceSaysIsNotTheNextReadsAnswer()
    {
        for (LineTime late = 1ms; late < 40ms; late += 137us) {
            FakeLine line;
            line.handler = [&](const Bytes &request) -> FakeLine::Answer {
                if (request[7] == 1)
                    return {{500us, oracle::status(3, 0, {6, 4, 38})}};
                const bool first = line.sent.size() == 1;
                return {{first ? late : LineTime(500us), oracle::status(3, 0, Bytes(4, first ? 9 : 1))}};
            };
            Traits traits;
            traits.id = 3;
            traits.statusReturnLevel = 0;
            Bus bus(line);
            bus.setTraits({traits});
            (void)bus.exchange(readRequest({3, 116, 4}), 0);
            const auto second = bus.exchange(readRequest({3, 132, 4}), 0);
            const Result<Reply> &reply = second->replies.front();
            QVERIFY2(!reply || reply->data == Bytes(4, 1), qPrintable(QString::number(late.count())));
        }
    }
};

DYNASCOPE_CORE_TEST(TestBusTraits)
#include "tst_bus_traits.moc"
