// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readplan.h"
#include "tests/support/hex.h"
#include "tests/support/testmain.h"

#include <algorithm>

using namespace dynascope;

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

/// Which requests read or write these spans at the least cost, and no packet too long for who must take it.
class TestReadPlan : public QObject
{
    Q_OBJECT

    /// Devices 0 to 99, of which number 40 has another buffer.
    static std::vector<Traits> withBuffer(int receiveBuffer)
    {
        std::vector<Traits> devices;
        for (int id = 0; id < 100; ++id)
            devices.push_back(traits(static_cast<std::uint8_t>(id), id % 2 == 0));
        devices[40].receiveBuffer = receiveBuffer;
        return devices;
    }

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

    void noPacketOutgrowsABuffer_data()
    {
        QTest::addColumn<int>("receiveBuffer");
        QTest::addColumn<bool>("same"); // address: Sync, else Bulk
        for (const int bytes : {64, 128, 256, 512, 1024, 4096}) {
            QTest::addRow("sync, %d bytes", bytes) << bytes << true;
            QTest::addRow("bulk, %d bytes", bytes) << bytes << false;
        }
    }

    /// Of those that device 40 stands in; the others may be longer.
    void noPacketOutgrowsABuffer()
    {
        QFETCH(int, receiveBuffer);
        QFETCH(bool, same);
        const std::vector<Traits> devices = withBuffer(receiveBuffer);
        const auto bound = static_cast<std::size_t>(std::min(receiveBuffer, MaximumPacketSize));
        std::vector<Span> spans;
        std::vector<SpanData> writes;
        for (const Traits &device : devices) {
            const auto address = static_cast<std::uint16_t>(same ? 132 : 0xFFFF - 3 * device.id);
            spans.push_back({device.id, address, 4});
            writes.push_back({device.id, address, hex::bytes("FF FF FD FF FF FD")}); // as much stuffing as can be
        }
        std::size_t covered = 0, withIt = 0, longest = 0;
        for (const PlannedExchange &planned : planReads(spans, devices)) {
            const std::size_t size = encode(planned.request.packet).size();
            const bool hasIt = std::ranges::count(planned.indices, 40U) > 0;
            if (hasIt)
                QVERIFY2(size <= bound, qPrintable(QString::number(size)));
            QVERIFY(size <= MaximumPacketSize);
            withIt += hasIt ? 1 : 0;
            longest = std::max(longest, planned.indices.size());
            covered += planned.indices.size();
        }
        QCOMPARE(covered, spans.size());
        QCOMPARE(withIt, std::size_t(1));
        QVERIFY(longest > 5); // they are not asked one by one because of it
        covered = 0;
        for (const Request &request : planWrites(writes, devices)) {
            const std::size_t size = encode(request.packet).size();
            QVERIFY2(size <= bound, qPrintable(QString::number(size)));
            covered += std::get<GroupWriteCommand>(*decodeCommand(request.packet)).writes.size();
        }
        QCOMPARE(covered, writes.size());
    }

    void aSmallBufferMakesMorePackets()
    {
        std::vector<SpanData> writes;
        for (int id = 0; id < 100; ++id)
            writes.push_back({static_cast<std::uint8_t>(id), 116, {1, 2, 3, 4}});
        const std::size_t usual = planWrites(writes, withBuffer(1024)).size();
        const std::size_t small = planWrites(writes, withBuffer(256)).size();
        QCOMPARE(usual, std::size_t(1));
        QVERIFY(small > 2 && small < 10);
        QCOMPARE(planWrites(writes, {}).size(), usual); // of an unknown device: what most have
    }

    void aDeviceWithoutGroupReadsStaysAlone()
    {
        std::vector<Traits> devices{traits(1, true), traits(2, true), traits(3, true)};
        devices[1].groupReads = false;
        const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, 132, 4}};
        QCOMPARE(toText(planReads(spans, devices)),
                 (QStringList{QStringLiteral("Read 2"), QStringLiteral("Fast Sync Read 1 3")}));
    }

    void pollSpansArePlannedAlike()
    {
        const std::vector<PollSpan> spans{{7, {1, 132, 4}, {}}, {8, {2, 132, 4}, {}}};
        const std::vector<Traits> devices{traits(1, false), traits(2, false)};
        QCOMPARE(toText(planExchanges(spans, devices, {})), QStringList(QStringLiteral("Sync Read 1 2")));
    }
};

DYNASCOPE_CORE_TEST(TestReadPlan)
#include "tst_readplan.moc"
