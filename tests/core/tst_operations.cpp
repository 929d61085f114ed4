// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "core/bus/readplan.h"
#include "tests/support/exchangetext.h"
#include "tests/support/fakeservos.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// "Fast Sync Read 1 2 3 @132+4", one line a request.
QString toText(const Request &request)
{
    QStringList parts{instructionName(request.packet.instruction)};
    for (const ExpectedReply &reply : request.replies)
        parts << QString::number(reply.id);
    return parts.join(QLatin1Char(' '));
}

QStringList toText(const std::vector<PlannedExchange> &plan)
{
    QStringList lines;
    for (const PlannedExchange &planned : plan)
        lines << toText(planned.request);
    return lines;
}

Traits traits(std::uint8_t id, bool fast, std::uint8_t level = 2)
{
    Traits result;
    result.id = id;
    result.fastReads = fast;
    result.statusReturnLevel = level;
    return result;
}

} // namespace

class TestOperations : public QObject
{
    Q_OBJECT

private slots:
    void plansTheCheapestReads_data()
    {
        QTest::addColumn<QList<QPair<int, int>>>("spans"); // ID, address
        QTest::addColumn<QString>("fast");                 // IDs that can
        QTest::addColumn<QStringList>("plan");
        using Spans = QList<QPair<int, int>>;
        const auto row = [](const char *name, const Spans &spans, const char *fast, const QStringList &plan) {
            QTest::newRow(name) << spans << QString::fromLatin1(fast) << plan;
        };
        row("nothing", {}, "", {});
        row("one", {{1, 132}}, "1", {QStringLiteral("Read 1")});
        row("three alike, all fast", {{1, 132}, {2, 132}, {3, 132}}, "1 2 3", {QStringLiteral("Fast Sync Read 1 2 3")});
        row("three alike, none fast", {{1, 132}, {2, 132}, {3, 132}}, "", {QStringLiteral("Sync Read 1 2 3")});
        row("three alike, one fast", {{1, 132}, {2, 132}, {3, 132}}, "2", {QStringLiteral("Sync Read 1 2 3")});
        row("four alike, two fast", {{1, 132}, {2, 132}, {3, 132}, {4, 132}}, "2 4",
            {QStringLiteral("Fast Sync Read 2 4"), QStringLiteral("Sync Read 1 3")});
        row("two fast, one not", {{1, 132}, {2, 132}, {3, 132}}, "1 3",
            {QStringLiteral("Fast Sync Read 1 3"), QStringLiteral("Read 2")});
        row("different addresses", {{1, 132}, {2, 126}}, "1 2", {QStringLiteral("Fast Bulk Read 1 2")});
        row("different addresses, plain", {{1, 132}, {2, 126}}, "", {QStringLiteral("Bulk Read 1 2")});
        row("one device twice", {{1, 132}, {1, 64}}, "1", {QStringLiteral("Read 1"), QStringLiteral("Read 1")});
        row("sync and a rest", {{1, 132}, {2, 132}, {1, 64}, {3, 70}}, "",
            {QStringLiteral("Sync Read 1 2"), QStringLiteral("Bulk Read 1 3")});
        row("order is kept", {{9, 132}, {2, 132}, {5, 132}}, "", {QStringLiteral("Sync Read 9 2 5")});
    }

    void plansTheCheapestReads()
    {
        using Spans = QList<QPair<int, int>>;
        QFETCH(Spans, spans);
        QFETCH(QString, fast);
        QFETCH(QStringList, plan);
        std::vector<Span> wanted;
        std::vector<Traits> devices;
        const QStringList able = fast.split(QLatin1Char(' '));
        for (const auto &[id, address] : spans) {
            wanted.push_back({static_cast<std::uint8_t>(id), static_cast<std::uint16_t>(address), 4});
            devices.push_back(traits(static_cast<std::uint8_t>(id), able.contains(QString::number(id))));
        }
        const auto planned = planReads(wanted, devices);
        QCOMPARE(toText(planned), plan);
        std::vector<int> seen(wanted.size(), 0);
        for (const PlannedExchange &exchange : planned) {
            QCOMPARE(exchange.indices.size(), exchange.request.replies.size());
            for (std::size_t i = 0; i < exchange.indices.size(); ++i) {
                ++seen[exchange.indices[i]];
                QCOMPARE(exchange.request.replies[i].id, wanted[exchange.indices[i]].id);
            }
        }
        QCOMPARE(seen, std::vector<int>(wanted.size(), 1));
    }

    void aMuteDeviceBreaksNoChain()
    {
        const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, 132, 4}};
        const std::vector<Traits> devices{traits(1, true), traits(2, true, 0), traits(3, true)};
        QCOMPARE(toText(planReads(spans, devices)),
            (QStringList{QStringLiteral("Read 2"), QStringLiteral("Fast Sync Read 1 3")}));
    }

    void splitsWhatDoesNotFit()
    {
        std::vector<Span> spans;
        std::vector<Traits> devices;
        for (int id = 0; id < 253; ++id) {
            spans.push_back({static_cast<std::uint8_t>(id), static_cast<std::uint16_t>(id % 2 ? 132 : 120), 40});
            devices.push_back(traits(static_cast<std::uint8_t>(id), id < 120));
        }
        std::size_t covered = 0;
        for (const bool same : {true, false}) {
            for (Span &span : spans)
                span.address = same ? 132 : static_cast<std::uint16_t>(span.id);
            covered = 0;
            for (const PlannedExchange &planned : planReads(spans, devices)) {
                QVERIFY(encode(planned.request.packet).size() <= MaximumPacketSize);
                if (planned.request.shape == ReplyShape::Fast)
                    QVERIFY(planned.request.maximumReplySize() <= MaximumPacketSize);
                covered += planned.indices.size();
            }
            QCOMPARE(covered, spans.size());
        }
        std::vector<SpanData> writes;
        for (int id = 0; id < 253; ++id)
            writes.push_back({static_cast<std::uint8_t>(id), 116, hex::bytes("FF FF FD FF FF FD")});
        covered = 0;
        for (const Request &request : planWrites(writes, devices)) {
            QVERIFY(encode(request.packet).size() <= MaximumPacketSize);
            covered += std::get<GroupWriteCommand>(*decodeCommand(request.packet)).writes.size();
        }
        QCOMPARE(covered, writes.size());
    }

    void plansWrites()
    {
        const auto text = [](const std::vector<SpanData> &writes) {
            QStringList lines;
            for (const Request &request : planWrites(writes, {}))
                lines << toText(request)
                        + QStringLiteral(" %1").arg(
                            std::get<GroupWriteCommand>(*decodeCommand(request.packet)).writes.size());
            return lines;
        };
        QCOMPARE(text({}), QStringList());
        QCOMPARE(text({{1, 64, {0}}}), QStringList(QStringLiteral("Sync Write 1")));
        QCOMPARE(text({{1, 64, {0}}, {2, 64, {0}}}), QStringList(QStringLiteral("Sync Write 2")));
        QCOMPARE(text({{1, 64, {0}}, {2, 65, {0}}}), QStringList(QStringLiteral("Bulk Write 2")));
        QCOMPARE(text({{1, 64, {0}}, {1, 65, {0}}, {2, 65, {0}}}),
            (QStringList{QStringLiteral("Sync Write 2"), QStringLiteral("Bulk Write 1")}));
    }

    void pingsReadsWrites()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[3].registers[132] = 0xA6;
        Bus bus(line);
        const auto pinged = ping(bus, 3);
        QVERIFY(pinged);
        QCOMPARE(pinged->modelNumber, 1025);
        QCOMPARE(pinged->firmware, 45);
        QCOMPARE(read(bus, {3, 132, 4})->data, (Bytes{0xA6, 0, 0, 0}));
        QVERIFY(write(bus, {3, 65, {1}}));
        QCOMPARE(devices.servos[3].registers[65], std::uint8_t(1));
        QCOMPARE(ping(bus, 4).error().kind, ErrorKind::NothingReceived);
        QCOMPARE(write(bus, {BroadcastId, 65, {0}}).has_value(), true);
    }

    void readsMany()
    {
        FakeLine line;
        FakeServos devices(line);
        for (const int id : {1, 2, 4})
            devices.servos[id].registers[132] = static_cast<std::uint8_t>(id);
        Bus bus(line);
        const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, 132, 4}, {4, 132, 4}};
        const auto values = readMany(bus, spans);
        QVERIFY(values);
        QCOMPARE((*values)[0]->data[0], std::uint8_t(1));
        QCOMPARE((*values)[1]->data[0], std::uint8_t(2));
        QVERIFY(!(*values)[2]); // missing; and the one behind it is read all the same
        QCOMPARE((*values)[3]->data[0], std::uint8_t(4));
    }

    void writesMany()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[1];
        devices.servos[2];
        Bus bus(line);
        const std::vector<SpanData> writes{{1, 116, {1, 0, 0, 0}}, {2, 116, {2, 0, 0, 0}}};
        QVERIFY(writeMany(bus, writes));
        QCOMPARE(devices.servos[1].registers[116], std::uint8_t(1));
        QCOMPARE(devices.servos[2].registers[116], std::uint8_t(2));
    }

    void verifiesByReadingBack()
    {
        FakeLine line;
        line.answer(oracle::status(3, 0, {})).answer(oracle::status(3, 0, {0})).answer(oracle::status(3, 0, {5}));
        Bus bus(line);
        QCOMPARE(*writeVerified(bus, {3, 9, {5}}), Bytes{5}); // EEPROM took a while

        FakeLine stubborn;
        stubborn.handler = [](const Bytes &request) -> FakeLine::Answer {
            return {{500us, oracle::status(3, 0, request[7] == 2 ? Bytes{0} : Bytes{})}};
        };
        Bus stubbornBus(stubborn);
        const auto value = writeVerified(stubbornBus, {3, 9, {5}});
        QCOMPARE(value.error().kind, ErrorKind::NotConfirmed);
        QCOMPARE(value.error().text, QStringLiteral("device 3 took the value, but reads back 00 instead of 05"));

        FakeLine refusing;
        refusing.answer(oracle::status(3, 7, {}));
        Bus refusingBus(refusing);
        QCOMPARE(writeVerified(refusingBus, {3, 9, {5}}).error().kind, ErrorKind::Refused);
    }

    void aLostAnswerToAWriteIsReadBack()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[3].registers[9] = 1;
        int statuses = 0;
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            FakeLine::Answer answer = devices.answer(request);
            if (request[7] == 3 && ++statuses <= 3)
                return {};
            return answer;
        };
        Bus bus(line);
        QCOMPARE(*writeVerified(bus, {3, 9, {5}}), Bytes{5});
    }

    void saysWhatBecameOfALostWrite()
    {
        const auto verified = [](const FakeLine::Handler &handler) {
            FakeLine line;
            line.handler = handler;
            Bus bus(line);
            return exchangetext::untimed(writeVerified(bus, {3, 9, {5}}).error().text);
        };
        const QString silence = QStringLiteral("device 3 did not answer: nothing was received in time; nothing else on the "
                                               "line has answered lately");
        const QString mayBe = QStringLiteral("; the write may have been executed");
        QCOMPARE(verified([](const Bytes &) { return FakeLine::Answer(); }), silence + mayBe);
        // Answers Ping, which proves that nothing older is in flight, and the write, but no Read.
        QCOMPARE(verified([](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 2)
                return {};
            return {{500us, oracle::status(3, 0, request[7] == 1 ? Bytes{6, 4, 38} : Bytes{})}};
        }), silence + mayBe);
        QCOMPARE(verified([](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 3)
                return {};
            return {{500us, oracle::status(3, 0, request[7] == 1 ? Bytes{6, 4, 38} : Bytes{1})}};
        }), silence + QStringLiteral("; the register reads back 01 instead of 05"));
    }

    void aSilentOneIsToldWithThoseAlive()
    {
        FakeLine line;
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[4] == 9)
                return {};
            return {{500us, oracle::status(request[4], 0, {6, 4, 38})}};
        };
        Bus bus(line);
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("nothing else on the line has answered lately")));
        QVERIFY(ping(bus, 1));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("; device 1 on this line answers")));
        QVERIFY(ping(bus, 3));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("; devices 1, 3 on this line answer")));
        QVERIFY(bus.wait(1min));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("nothing else on the line has answered lately")));
    }
};

DYNASCOPE_CORE_TEST(TestOperations)
#include "tst_operations.moc"
