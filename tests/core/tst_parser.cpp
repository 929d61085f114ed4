// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/parser.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

#include <QRandomGenerator>

using namespace dynascope;

namespace {

QString toText(const Parser::Event &event)
{
    if (const auto *packet = std::get_if<Parser::Packet>(&event))
        return QStringLiteral("%1 of %2%3%4: %5")
            .arg(instructionName(packet->instruction))
            .arg(packet->id)
            .arg(packet->errorField ? QStringLiteral(" error %1").arg(packet->errorField, 2, 16, QLatin1Char('0'))
                                    : QString(),
                packet->forgotStuffing ? QStringLiteral(" bare") : QString(), hex::text(packet->parameters));
    if (const auto *damaged = std::get_if<Parser::Damaged>(&event))
        return QStringLiteral("damaged %1").arg(damaged->raw.size());
    return QStringLiteral("noise %1").arg(std::get<Parser::Noise>(event).bytes);
}

void drain(Parser &parser, QStringList &events)
{
    while (const auto event = parser.next())
        events << toText(*event);
}

/// The events of a stream that comes in pieces of these sizes, used in turn.
QStringList events(const Bytes &stream, const std::vector<std::size_t> &chunks = {1u << 20})
{
    Parser parser;
    QStringList result;
    std::size_t at = 0;
    for (std::size_t turn = 0; at < stream.size(); ++turn) {
        const std::size_t size = std::min(chunks[turn % chunks.size()], stream.size() - at);
        parser.feed(ByteView(stream).subspan(at, size));
        at += size;
        drain(parser, result);
    }
    while (!parser.buffered().empty()) { // as after the deadline
        parser.giveUp();
        drain(parser, result);
    }
    return result;
}

Bytes join(std::initializer_list<Bytes> parts)
{
    Bytes all;
    for (const Bytes &part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

const Bytes Good = oracle::status(1, 0, {0xA6, 0, 0, 0});
const QString GoodText = QStringLiteral("Status of 1: A6 00 00 00");

} // namespace

class TestParser : public QObject
{
    Q_OBJECT

private slots:
    void stream_data()
    {
        QTest::addColumn<Bytes>("stream");
        QTest::addColumn<QStringList>("expected");
        const auto row = [](const char *name, const Bytes &stream, const QStringList &expected) {
            QTest::newRow(name) << stream << expected;
        };
        row("nothing", {}, {});
        row("one packet", Good, {GoodText});
        row("two packets", join({Good, Good}), {GoodText, GoodText});
        row("noise first", join({{0x00, 0x12, 0xFF}, Good}), {QStringLiteral("noise 3"), GoodText});
        row("noise that looks like a header", join({hex::bytes("FF FF FF FD"), Good}),
            {QStringLiteral("noise 4"), GoodText});
        row("FF FF before the header", join({{0xFF, 0xFF}, Good}), {QStringLiteral("noise 2"), GoodText});
        row("noise between", join({Good, {1, 2, 3}, Good}), {GoodText, QStringLiteral("noise 3"), GoodText});
        Bytes broken = Good;
        broken[9] ^= 0x10;
        row("damaged, then good", join({broken, Good}), {QStringLiteral("damaged 15"), GoodText});
        Bytes longer = Good;
        longer[5] = 20; // takes some of the next packet with it
        row("damaged length swallows the next", join({longer, Good, Good}),
            {QStringLiteral("damaged 27"), GoodText, GoodText});
        row("cut off, then good", join({Bytes(Good.begin(), Good.begin() + 9), Good}),
            {QStringLiteral("damaged 15"), GoodText});
        row("status with LEN 3", join({hex::bytes("FF FF FD 00 01 03 00 55 00 00"), Good}),
            {QStringLiteral("noise 10"), GoodText});
        row("LEN 0", join({hex::bytes("FF FF FD 00 01 00 00"), Good}), {QStringLiteral("noise 7"), GoodText});
        row("LEN past every buffer", join({hex::bytes("FF FF FD 00 01 FF FF 55"), Good}),
            {QStringLiteral("noise 8"), GoodText});
        row("ID 253", join({hex::bytes("FF FF FD 00 FD 04 00 55 00"), Good}), {QStringLiteral("noise 9"), GoodText});
        row("ID 255", join({hex::bytes("FF FF FD 00 FF 04 00 55 00"), Good}), {QStringLiteral("noise 9"), GoodText});
        row("echo and answer", join({oracle::instruction(1, 2, {132, 0, 4, 0}), Good}),
            {QStringLiteral("Read of 1: 84 00 04 00"), GoodText});
        row("alert and error", oracle::status(7, 0x87, {}), {QStringLiteral("Status of 7 error 87: ")});
        row("header-like data", oracle::status(1, 0, hex::bytes("FF FF FD 00 01 04 00")),
            {QStringLiteral("Status of 1: FF FF FD 00 01 04 00")});
        row("forgot to stuff", bare(), {QStringLiteral("Status of 2 bare: FF FF FD 01")});
        row("fast", hex::bytes("FF FF FD 00 FE 14 00 55 00 03 A6 00 00 00 67 A4 00 07 A5 01 24 74 00 04 1F D9 C1"),
            {QStringLiteral("Status of 254: 00 03 A6 00 00 00 67 A4 00 07 A5 01 24 74 00 04 1F D9 C1")});
        row("only the begin of a header", hex::bytes("FF FF FD"), {});
    }

    void stream()
    {
        QFETCH(Bytes, stream);
        QFETCH(QStringList, expected);
        QCOMPARE(events(stream), expected);
        for (std::size_t size = 1; size <= 7; ++size) {
            QCOMPARE(events(stream, {size}), expected);
        }
        QCOMPARE(events(stream, {1, 5, 2, 9, 3}), expected);
    }

    void anyChunkingOfARandomStream()
    {
        QRandomGenerator random(7);
        for (int round = 0; round < 200; ++round) {
            Bytes stream;
            while (stream.size() < 400)
                append(stream, random);
            const QStringList whole = events(stream);
            for (int cut = 0; cut < 4; ++cut) {
                std::vector<std::size_t> chunks;
                for (int i = 0; i < 8; ++i)
                    chunks.push_back(1 + random.bounded(cut == 0 ? 2U : 40U));
                QCOMPARE(events(stream, chunks), whole);
            }
        }
    }

    void neverReadsPastWhatCame()
    {
        // Every short stream over what matters most; a sanitizer build would see a step too far.
        constexpr std::uint8_t Alphabet[] = {0xFF, 0xFD, 0x00, 0x55, 0x04};
        for (int number = 0; number < 5 * 5 * 5 * 5 * 5; ++number) {
            Bytes stream = hex::bytes("FF FF FD 00 01");
            for (int rest = number, i = 0; i < 5; ++i, rest /= 5)
                stream.push_back(Alphabet[rest % 5]);
            events(stream);
        }
    }

    void tellsWhatIsPending()
    {
        Parser parser;
        QCOMPARE(parser.pending().have, std::size_t(0));
        parser.feed(ByteView(Good).first(3));
        QVERIFY(!parser.next());
        QCOMPARE(parser.pending().have, std::size_t(0));
        parser.feed(ByteView(Good).subspan(3, 2));
        QVERIFY(!parser.next());
        QCOMPARE(parser.pending().have, std::size_t(5));
        QCOMPARE(parser.pending().want, std::size_t(0));
        parser.feed(ByteView(Good).subspan(5, 4));
        QVERIFY(!parser.next());
        QCOMPARE(parser.pending().have, std::size_t(9));
        QCOMPARE(parser.pending().want, std::size_t(15));
        parser.giveUp();
        QVERIFY(!parser.next());
        QCOMPARE(parser.noiseBytes(), std::size_t(9));
    }

    void boundsTheLength()
    {
        Parser parser(20);
        parser.feed(oracle::status(1, 0, Bytes(30, 0)));
        QVERIFY(!parser.next());
        QCOMPARE(parser.pending().have, std::size_t(0));
        parser.feed(Good);
        QCOMPARE(toText(*parser.next()), QStringLiteral("noise 41"));
        QCOMPARE(toText(*parser.next()), GoodText);
    }

    void countsADamagedPacketOnce()
    {
        Bytes broken = Good;
        broken[10] ^= 1;
        Parser parser;
        parser.feed(join({broken, {9}, Good}));
        QStringList all;
        drain(parser, all);
        QCOMPARE(all, (QStringList{QStringLiteral("damaged 15"), QStringLiteral("noise 1"), GoodText}));
        QCOMPARE(parser.noiseBytes(), std::size_t(1));
    }

private:
    static Bytes bare()
    {
        Bytes packet = hex::bytes("FF FF FD 00 02 08 00 55 00 FF FF FD 01");
        const std::uint16_t crc = oracle::crc(packet);
        packet.push_back(static_cast<std::uint8_t>(crc));
        packet.push_back(static_cast<std::uint8_t>(crc >> 8));
        return packet;
    }

    static void append(Bytes &stream, QRandomGenerator &random)
    {
        Bytes piece;
        switch (random.bounded(5)) {
        case 0: // noise made of what headers are made of
            for (quint32 i = random.bounded(12U); i > 0; --i)
                piece.push_back(hex::bytes("FF FD 00 55 01")[random.bounded(5U)]);
            break;
        case 1:
            piece = oracle::status(3, 0, Bytes(random.bounded(9U), 0xFF));
            piece[random.bounded(static_cast<quint32>(piece.size()))] ^= 4;
            break;
        case 2: piece = Bytes(Good.begin(), Good.begin() + static_cast<int>(random.bounded(14U))); break;
        default: piece = oracle::status(2, 0, hex::bytes("FF FF FD FF FF FD 00 12")); break;
        }
        stream.insert(stream.end(), piece.begin(), piece.end());
    }
};

DYNASCOPE_CORE_TEST(TestParser)
#include "tst_parser.moc"
