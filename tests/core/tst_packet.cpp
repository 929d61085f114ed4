// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/packet.h"
#include "core/protocol/parser.h"
#include "core/protocol/requests.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;

namespace {

struct Example {
    QString name;
    QString kind;
    QString bytes;
};

/// Lines of: "name",kind,bytes
std::vector<Example> manualExamples()
{
    std::vector<Example> examples;
    QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/manual_examples.csv"));
    if (!file.open(QIODevice::ReadOnly))
        return examples;
    file.readLine();
    while (!file.atEnd()) {
        const QString line = QString::fromUtf8(file.readLine()).trimmed();
        const QString name = line.section(QLatin1Char('"'), 1, 1);
        const QStringList rest = line.section(QLatin1Char('"'), 2).split(QLatin1Char(','));
        if (rest.size() == 3)
            examples.push_back({name, rest[1], rest[2].trimmed()});
    }
    return examples;
}

Bytes plain(const char *text)
{
    return hex::bytes(text);
}

StatusPacket status(std::uint8_t id, const char *parameters, DeviceError error = DeviceError::None, bool alert = false)
{
    return {id, error, alert, plain(parameters)};
}

Bytes position(int value)
{
    Bytes data;
    appendLittleEndian(data, static_cast<std::uint32_t>(value), 4);
    return data;
}

/// What each example means, said with our own words. By name, as two of them have the same bytes.
QHash<QString, Bytes> meanings()
{
    const std::array<std::uint8_t, 2> oneAndTwo{1, 2};
    const std::array<Span, 2> bulk{Span{1, 144, 2}, Span{2, 146, 1}};
    const std::array<SpanData, 2> sync{SpanData{1, 116, position(150)}, SpanData{2, 116, position(170)}};
    const std::array<SpanData, 2> bulkWrites{SpanData{1, 32, {160, 0}}, SpanData{2, 31, {80}}};
    const auto request = [](const Request &value) { return encode(value.packet); };
    const Bytes done = encode(status(1, ""));
    return {
        {QStringLiteral("ping 1"), request(pingRequest(1))},
        {QStringLiteral("ping 1: status, model 1030, firmware 38"), encode(status(1, "06 04 26"))},
        {QStringLiteral("broadcast ping"), request(pingRequest(BroadcastId))},
        {QStringLiteral("broadcast ping: status of 1"), encode(status(1, "06 04 26"))},
        {QStringLiteral("broadcast ping: status of 2"), encode(status(2, "06 04 26"))},
        {QStringLiteral("read 1, 132, 4 bytes"), request(readRequest({1, 132, 4}))},
        {QStringLiteral("read: status, 166"), encode(status(1, "A6 00 00 00"))},
        {QStringLiteral("write 1, 116 = 512"), request(writeRequest({1, 116, position(512)}))},
        {QStringLiteral("write: status"), done},
        {QStringLiteral("reg write 1, 104 = 200"), request(regWriteRequest({1, 104, position(200)}))},
        {QStringLiteral("reg write: status"), done},
        {QStringLiteral("action 1"), request(actionRequest(1))},
        {QStringLiteral("action: status"), done},
        {QStringLiteral("factory reset 1, all but ID"), request(factoryResetRequest(1, ResetOption::AllButId))},
        {QStringLiteral("factory reset: status"), done},
        {QStringLiteral("reboot 1"), request(rebootRequest(1))},
        {QStringLiteral("reboot: status"), done},
        {QStringLiteral("clear 1, multi-turn"), request(clearRequest(1, ClearOption::Position))},
        {QStringLiteral("clear: status"), done},
        {QStringLiteral("sync read 1 and 2, 132, 4 bytes"), request(syncReadRequest(132, 4, oneAndTwo, false))},
        {QStringLiteral("sync read: status of 1, 166"), encode(status(1, "A6 00 00 00"))},
        {QStringLiteral("sync read: status of 2, 2079"), encode(status(2, "1F 08 00 00"))},
        {QStringLiteral("sync write 116, 4 bytes: 1 = 150, 2 = 170"), request(syncWriteRequest(sync))},
        {QStringLiteral("bulk read 1 @144+2, 2 @146+1"), request(bulkReadRequest(bulk, false))},
        {QStringLiteral("bulk read: status of 1, 119"), encode(status(1, "77 00"))},
        {QStringLiteral("bulk read: status of 2, 36"), encode(status(2, "24"))},
        {QStringLiteral("bulk write 1 @32 = 160, 2 @31 = 80"), request(bulkWriteRequest(bulkWrites))},
    };
}

} // namespace

class TestPacket : public QObject
{
    Q_OBJECT

private slots:
    void manualExample_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("wire");
        for (const Example &example : manualExamples())
            QTest::newRow(qPrintable(example.name)) << example.name << example.kind << example.bytes;
    }

    void manualExample()
    {
        QFETCH(QString, name);
        QFETCH(QString, kind);
        QFETCH(QString, wire);
        const auto all = meanings();
        QVERIFY2(all.contains(name), "an example without a meaning");
        QCOMPARE(hex::text(all.value(name)), wire);

        Parser parser;
        parser.feed(hex::bytes(qPrintable(wire)));
        const auto event = parser.next();
        QVERIFY(event && std::holds_alternative<Parser::Packet>(*event));
        const auto &packet = std::get<Parser::Packet>(*event);
        QCOMPARE(packet.isStatus(), kind == QLatin1String("status"));
        const Bytes again = packet.isStatus() ? encode(packet.status()) : encode(packet.request());
        QCOMPARE(hex::text(again), wire);
    }

    void allExamplesAreThere() { QCOMPARE(manualExamples().size(), std::size_t(27)); }

    void encodes_data()
    {
        QTest::addColumn<QString>("made");
        QTest::addColumn<QString>("wire");
        const auto row = [](const char *wire, const Bytes &made) {
            QTest::newRow(wire) << hex::text(made) << QString::fromLatin1(wire);
        };
        const auto request = [](const Request &value) { return encode(value.packet); };
        row("FF FF FD 00 01 0A 00 03 74 00 FF FF FD FD 00 21 E7",
            request(writeRequest({1, 116, plain("FF FF FD 00")})));
        row("FF FF FD 00 01 0A 00 03 74 00 00 FF FF FD FD 2F CD",
            request(writeRequest({1, 116, plain("00 FF FF FD")})));
        row("FF FF FD 00 01 09 00 03 74 00 FF FF FF FF C8 89", request(writeRequest({1, 116, plain("FF FF FF FF")})));
        const std::array<SpanData, 2> patterns{
            SpanData{1, 116, plain("FF FF FD FF")}, SpanData{2, 116, plain("FF FF FD FD")}};
        row("FF FF FD 00 FE 13 00 83 74 00 04 00 01 FF FF FD FD FF 02 FF FF FD FD FD FD 38",
            request(syncWriteRequest(patterns)));
        row("FF FF FD 00 01 0F 00 55 00 FF FF FD FD 00 00 00 A6 00 00 00 F1 F8",
            encode(status(1, "FF FF FD 00 00 00 A6 00 00 00")));
        const auto reset = [&](ResetOption option) { return request(factoryResetRequest(1, option)); };
        row("FF FF FD 00 01 04 00 06 FF A6 64", reset(ResetOption::All));
        row("FF FF FD 00 01 04 00 06 01 A1 E6", reset(ResetOption::AllButId));
        row("FF FF FD 00 01 04 00 06 02 AB E6", reset(ResetOption::AllButIdAndBaud));
        row("FF FF FD 00 01 08 00 10 01 44 58 4C 22 B1 DC", request(clearRequest(1, ClearOption::Position)));
        row("FF FF FD 00 01 08 00 10 02 45 52 43 4C D5 EB", request(clearRequest(1, ClearOption::Error)));
        row("FF FF FD 00 01 08 00 20 01 43 54 52 4C 16 F5", request(backupRequest(1, BackupOption::Store)));
        row("FF FF FD 00 01 08 00 20 02 43 54 52 4C 9E F5", request(backupRequest(1, BackupOption::Restore)));
        row("FF FF FD 00 FE 03 00 05 2A C2", request(actionRequest(BroadcastId)));
        row("FF FF FD 00 FE 03 00 08 07 42", request(rebootRequest(BroadcastId)));
        const std::array<std::uint8_t, 3> ids{3, 7, 4};
        row("FF FF FD 00 FE 0A 00 8A 84 00 04 00 03 07 04 20 F2", request(syncReadRequest(132, 4, ids, true)));
        const std::array<Span, 3> spans{Span{3, 132, 4}, Span{7, 124, 2}, Span{4, 146, 1}};
        row("FF FF FD 00 FE 12 00 9A 03 84 00 04 00 07 7C 00 02 00 04 92 00 01 00 DA 2D",
            request(bulkReadRequest(spans, true)));
        const std::array<FastBlock, 3> sync{
            status(3, "A6 00 00 00"), status(7, "1F 08 00 00"), status(4, "FF 03 00 00")};
        row("FF FF FD 00 FE 19 00 55 00 03 A6 00 00 00 84 08 00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00 D1 9E",
            encodeFastStatus(sync));
        const std::array<FastBlock, 3> bulk{status(3, "A6 00 00 00"), status(7, "A5 01"), status(4, "1F")};
        Bytes third = encodeFastStatus(bulk);
        row("FF FF FD 00 FE 14 00 55 00 03 A6 00 00 00 67 A4 00 07 A5 01 24 74 00 04 1F D9 C1", third);
    }

    void encodes()
    {
        QFETCH(QString, made);
        QFETCH(QString, wire);
        QCOMPARE(made, wire);
    }

    void agreesWithTheOracle()
    {
        for (int i = 0; i < 300; ++i) {
            Bytes parameters;
            for (int k = 0; k < i % 40; ++k)
                parameters.push_back(k % 5 == 2 ? 0xFD : (k + i) % 7 == 0 ? static_cast<std::uint8_t>(k) : 0xFF);
            const auto id = static_cast<std::uint8_t>(i % 253);
            const Bytes expected = oracle::instruction(id, 3, parameters);
            QCOMPARE(hex::text(encode(InstructionPacket{id, Instruction::Write, parameters})), hex::text(expected));
            const Bytes answer = oracle::status(id, 0x87, parameters);
            const StatusPacket packet{id, DeviceError::Access, true, parameters};
            QCOMPARE(hex::text(encode(packet)), hex::text(answer));
            Parser parser;
            parser.feed(answer);
            const auto event = parser.next();
            QVERIFY(event && std::holds_alternative<Parser::Packet>(*event));
            QCOMPARE(std::get<Parser::Packet>(*event).status(), packet);
        }
    }
};

DYNASCOPE_CORE_TEST(TestPacket)
#include "tst_packet.moc"
