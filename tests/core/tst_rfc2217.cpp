// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/rfc2217.h"
#include "tests/support/hex.h"
#include "tests/support/testmain.h"

#include <random>

using namespace dynascope;

namespace {

constexpr std::size_t Whole = 100'000;

/// What a client makes of a stream that comes in pieces of this size.
struct Heard {
    Bytes data;
    Bytes answer;
    Rfc2217 client;
};

Heard hear(const Bytes &stream, std::size_t piece, Rfc2217 client = {})
{
    Heard heard;
    heard.client = client;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        const std::size_t size = std::min(piece, stream.size() - at);
        heard.client.feed(ByteView(stream).subspan(at, size), heard.data, heard.answer);
    }
    return heard;
}

Rfc2217 asking(int rate)
{
    Rfc2217 client;
    (void)client.requestRate(rate);
    return client;
}

} // namespace

/// Expected bytes are written out from RFC 854 and RFC 2217; ser2net itself is met in tests/integration.
class TestRfc2217 : public QObject
{
    Q_OBJECT

private slots:
    void says()
    {
        QCOMPARE(hex::text(Rfc2217::greeting()),
                 QStringLiteral(
                     "FF FB 2C FF FB 00 FF FD 00 FF FB 03 FF FD 03")); // WILL 44, binary and no go-ahead both ways
        QCOMPARE(hex::text(Rfc2217().requestRate(57600)),
                 QStringLiteral("FF FA 2C 01 00 00 E1 00 FF F0 FF FA 2C 0C 01 FF F0"));
        QCOMPARE(hex::text(Rfc2217().requestRate(65'280)), // 00 00 FF 00
                 QStringLiteral("FF FA 2C 01 00 00 FF FF 00 FF F0 FF FA 2C 0C 01 FF F0"));
        QCOMPARE(hex::text(Rfc2217::portSettings()),
                 QStringLiteral("FF FA 2C 02 08 FF F0 FF FA 2C 03 01 FF F0 FF FA 2C 04 01 FF F0 FF FA 2C 05 01 FF F0 "
                                "FF FA 2C 05 0E FF F0 FF FA 2C 0A 00 FF F0 FF FA 2C 0B 00 FF F0"));
        QCOMPARE(hex::text(Rfc2217::escaped(hex::bytes("FF FF FD 00 01"))), QStringLiteral("FF FF FF FF FD 00 01"));
        QVERIFY(Rfc2217::escaped({}).empty());
    }

    void understands_data()
    {
        QTest::addColumn<QString>("stream");
        QTest::addColumn<QString>("data");
        QTest::addColumn<QString>("answer");
        const auto row = [](const char *name, const char *stream, const char *data, const char *answer) {
            QTest::newRow(name) << QString::fromLatin1(stream) << QString::fromLatin1(data)
                                << QString::fromLatin1(answer);
        };
        row("data", "01 02 03", "01 02 03", "");
        row("doubled FF", "FF FF FF FF FD 00", "FF FF FD 00", "");
        row("line ends are left alone", "0D 0A 0D 00 11 13 0D", "0D 0A 0D 00 11 13 0D", "");
        row("commands without more", "01 FF F1 02 FF F9 03 FF F0 04", "01 02 03 04", "");
        row("what we asked for", "FF FB 00 FF FD 00 FF FB 03 FF FD 03 FF FD 2C", "", "");
        row("what we don't want", "FF FD 01 FF FB 01 FF FD 18 FF FB 05", "", "FF FC 01 FF FE 01 FF FC 18 FF FE 05");
        row("asked again and again", "FF FD 18 FF FD 18 FF FD 18 FF FB 18 FF FB 18", "", "FF FC 18 FF FE 18");
        row("refusals need no answer", "FF FC 01 FF FE 01 FF FC 00 FF FE 00", "", "");
        row("the server offers it", "FF FB 2C FF FB 2C", "", "FF FD 2C");
        row("a subnegotiation between data", "41 FF FA 2C 6B 00 FF F0 42", "41 42", "");
        row("with a doubled FF", "41 FF FA 2C 6B FF FF F0 FF F0 42", "41 42", "");
        row("of another option", "41 FF FA 18 01 FF F0 42", "41 42", "");
        row("empty", "41 FF FA FF F0 42", "41 42", "");
        row("broken off by a command", "41 FF FA 2C 65 00 FF FD 18 42", "41 42", "FF FC 18");
        row("never ended", "41 FF FA 2C 65 00 01 02", "41", "");
    }
    void understands()
    {
        QFETCH(QString, stream);
        QFETCH(QString, data);
        QFETCH(QString, answer);
        const Bytes bytes = hex::bytes(stream.toLatin1().constData());
        for (const std::size_t piece : {Whole, std::size_t(1), std::size_t(2), std::size_t(3), std::size_t(5)}) {
            const Heard heard = hear(bytes, piece);
            QCOMPARE(hex::text(heard.data), data);
            QCOMPARE(hex::text(heard.answer), answer);
        }
    }

    void agrees()
    {
        using enum Rfc2217::Agreement;
        QCOMPARE(Rfc2217().agreement(), Pending);
        QCOMPARE(hear(hex::bytes("FF FD 2C"), 1).client.agreement(), Agreed);
        QCOMPARE(hear(hex::bytes("FF FB 2C"), 1).client.agreement(), Agreed);
        QCOMPARE(hear(hex::bytes("FF FE 2C"), 1).client.agreement(), Refused);
        QCOMPARE(hear(hex::bytes("FF FD 00 FF FB 01"), 1).client.agreement(), Pending);
        QCOMPARE(hear(hex::bytes("2C FF FF FD 2C"), 1).client.agreement(), Pending); // data
    }

    void confirmsARate_data()
    {
        QTest::addColumn<QString>("stream");
        QTest::addColumn<int>("rate"); // -1: none
        const auto row = [](const char *name, const char *stream, int rate) {
            QTest::newRow(name) << QString::fromLatin1(stream) << rate;
        };
        row("as asked", "FF FA 2C 65 00 0F 42 40 FF F0", 1'000'000);
        row("another", "FF FA 2C 65 00 00 25 80 FF F0", 9600);
        row("doubled FF", "FF FA 2C 65 00 00 FF FF 00 FF F0", 65'280);
        row("between data", "01 FF FF FF FA 2C 65 00 0F 42 40 FF F0 FF FF 02", 1'000'000);
        row("negative as an int", "FF FA 2C 65 80 00 00 00 FF F0", 0);
        row("all bits", "FF FA 2C 65 FF FF FF FF FF FF FF FF FF F0", 0);
        row("too short", "FF FA 2C 65 00 0F 42 FF F0", -1);
        row("too long", "FF FA 2C 65 00 0F 42 40 00 FF F0", -1);
        row("another command", "FF FA 2C 66 00 0F 42 40 FF F0", -1);
        row("the client's own number", "FF FA 2C 01 00 0F 42 40 FF F0", -1);
        row("another option", "FF FA 18 65 00 0F 42 40 FF F0", -1);
        row("cut off", "FF FA 2C 65 00 0F 42 40 FF", -1);
        row("only the first counts", "FF FA 2C 65 00 00 25 80 FF F0 FF FA 2C 65 00 0F 42 40 FF F0", 9600);
    }
    void confirmsARate()
    {
        QFETCH(QString, stream);
        QFETCH(int, rate);
        const Bytes bytes = hex::bytes(stream.toLatin1().constData());
        for (const std::size_t piece : {Whole, std::size_t(1), std::size_t(2), std::size_t(3)})
            QCOMPARE(hear(bytes, piece, asking(1'000'000)).client.confirmedRate().value_or(-1), rate);
        QVERIFY(!hear(bytes, 1).client.confirmedRate()); // nobody asked
    }

    void aNewRequestForgetsTheLastAnswer()
    {
        Heard heard = hear(hex::bytes("FF FA 2C 65 00 0F 42 40 FF F0"), 1, asking(1'000'000));
        QCOMPARE(heard.client.confirmedRate(), 1'000'000);
        (void)heard.client.requestRate(57600);
        QVERIFY(!heard.client.confirmedRate());
    }

    void endlessSubnegotiations()
    {
        Bytes stream = hex::bytes("FF FA 2C 65");
        stream.resize(5'000'000, 0x41);
        Heard heard = hear(stream, Whole, asking(57600));
        QVERIFY(heard.data.empty() && heard.answer.empty());
        heard.client.feed(hex::bytes("FF F0 42"), heard.data, heard.answer);
        QCOMPARE(hex::text(heard.data), QStringLiteral("42"));
        QVERIFY(!heard.client.confirmedRate());
    }

    void whateverComes()
    {
        std::mt19937 random(2217);
        for (int run = 0; run < 300; ++run) {
            Bytes stream(2000);
            for (std::uint8_t &byte : stream) {
                static constexpr std::uint8_t telling[] = {0xFF, 0xFF, 0xFA, 0xF0, 0xFB, 0xFD, 0x2C, 0x65};
                byte = static_cast<std::uint8_t>(random() % 2 ? telling[random() % 8] : random());
            }
            const Heard whole = hear(stream, Whole, asking(57600));
            const Heard pieces = hear(stream, 1 + random() % 7, asking(57600));
            QCOMPARE(whole.data, pieces.data);
            QCOMPARE(whole.answer, pieces.answer);
            QCOMPARE(whole.client.confirmedRate(), pieces.client.confirmedRate());
            QVERIFY(whole.data.size() <= stream.size());
            QVERIFY(whole.answer.size() <= 2u * 256 * 3);
        }
    }

    void whatWeEscapeComesBack()
    {
        std::mt19937 random(854);
        Bytes data(5000);
        for (std::uint8_t &byte : data)
            byte = static_cast<std::uint8_t>(random() % 3 ? 0xFF : random());
        const Heard heard = hear(Rfc2217::escaped(data), 7);
        QCOMPARE(heard.data, data);
        QVERIFY(heard.answer.empty());
    }
};

DYNASCOPE_CORE_TEST(TestRfc2217)
#include "tst_rfc2217.moc"
