// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedline.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

#include <algorithm>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

using Kind = ReplyFault::Kind;

namespace {

constexpr LineTime ByteAt1M = 10us;

Bytes join(std::initializer_list<Bytes> parts)
{
    Bytes all;
    for (const Bytes &part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

Bytes firstBytes(const Bytes &bytes, std::size_t count)
{
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count)};
}

bool contains(const Bytes &bytes, const Bytes &part)
{
    return std::search(bytes.begin(), bytes.end(), part.begin(), part.end()) != bytes.end();
}

/// Indices of the bits that differ, in serial order.
std::vector<std::size_t> turnedBits(const Bytes &one, const Bytes &other)
{
    std::vector<std::size_t> bits;
    for (std::size_t i = 0; i < 8 * std::min(one.size(), other.size()); ++i) {
        if (((one[i / 8] ^ other[i / 8]) >> (i % 8)) & 1)
            bits.push_back(i);
    }
    return bits;
}

} // namespace

/// Each fault of a simulated line by itself: what of it stands on the wire and what the controller hears. Three servos
/// at 1 Mbps; ID 1 is asked for its model number and firmware.
class TestLineFaults : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bus = makeBus();
        QVERIFY(m_bus);
    }

    void echo()
    {
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.echo = {.on = true}});
        QCOMPARE(hex(client.exchange(m_ping)), hex(join({m_ping, m_answer})));
        QCOMPARE(client.firstByte, LineTime{}); // all of it is there when the last byte has left
        m_bus->setFaults({.echo = {.on = true, .delay = 2ms}});
        QCOMPARE(hex(client.exchange(m_ping)), hex(join({m_ping, m_answer})));
        QCOMPARE(client.firstByte, 2ms - 9 * ByteAt1M);
        m_bus->setFaults({.echo = {.on = true, .damage = Damage{PacketPart::Id, 1, 0, 3}}});
        Bytes changed = m_ping;
        changed[4] ^= 0x08;
        QCOMPARE(hex(client.exchange(m_ping)), hex(join({changed, m_answer})));
        m_bus->setFaults({});
        QCOMPARE(hex(client.exchange(m_ping)), hex(m_answer));
    }

    void latencyTimer()
    {
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.latencyTimer = 16ms});
        QCOMPARE(hex(client.exchange(m_ping, 40ms)), hex(m_answer));
        QCOMPARE(client.firstByte, 16ms + 600us + ByteAt1M);
        // 100 bytes of data: a full buffer goes at once, the rest when the timer ends.
        m_bus->send(instruction(QStringLiteral("01 02 00 00 64 00")), client.now, client.baudRate);
        const LineTime begin = client.now + (14 * ByteAt1M) + 600us;
        Bytes heard;
        m_bus->receive(heard, begin + 61 * ByteAt1M, client.baudRate);
        QCOMPARE(heard.size(), std::size_t(0));
        m_bus->receive(heard, begin + 62 * ByteAt1M, client.baudRate);
        QCOMPARE(heard.size(), std::size_t(62));
        m_bus->receive(heard, begin + 63 * ByteAt1M + 15999us, client.baudRate);
        QCOMPARE(heard.size(), std::size_t(62));
        m_bus->receive(heard, begin + 63 * ByteAt1M + 16ms, client.baudRate);
        QCOMPARE(heard.size(), std::size_t(111));
    }

    void aLateReplyKeepsItsPlace()
    {
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.replies = {{.kind = Kind::Late, .time = 20ms}}});
        QCOMPARE(hex(client.exchange(m_ping, 5ms)), QString());
        const Bytes second = status(QStringLiteral("02 00 FC 03 2D"));
        QCOMPARE(hex(client.exchange(QStringLiteral("02 01"), 5ms)), QString()); // waits behind the first
        QCOMPARE(hex(client.exchange(QStringLiteral("03 01"), 20ms)),
                 hex(join({m_answer, second, status(QStringLiteral("03 00 FC 03 2D"))})));
    }

    void cutAtEveryByte()
    {
        Client client{*m_bus, 1'000'000};
        const Bytes sync = instruction(QStringLiteral("FE 82 00 00 02 00 01 02 03"));
        const Bytes one = status(QStringLiteral("01 00 FC 03")), two = status(QStringLiteral("02 00 FC 03"));
        const Bytes three = status(QStringLiteral("03 00 FC 03"));
        for (std::size_t kept = 0; kept < two.size(); ++kept) {
            ReplyFault cut{.kind = Kind::Cut, .id = 2, .amount = static_cast<int>(kept)};
            m_bus->setFaults({.replies = {cut}});
            QCOMPARE(hex(client.exchange(sync)), hex(join({one, firstBytes(two, kept)}))); // 3 waits for 2
            cut.atAdapter = true;
            m_bus->setFaults({.replies = {cut}});
            QCOMPARE(hex(client.exchange(sync)), hex(join({one, firstBytes(two, kept), three})));
            QCOMPARE(hex(client.exchange(sync)), hex(join({one, two, three})));
        }
    }

    void damage_data()
    {
        QTest::addColumn<Damage>("damage");
        QTest::addColumn<int>("firstByte"); // of those that may be changed
        QTest::addColumn<int>("bytes");
        QTest::newRow("header") << Damage{PacketPart::Header} << 0 << 4;
        QTest::newRow("ID") << Damage{PacketPart::Id, 2} << 4 << 1;
        QTest::newRow("LEN") << Damage{PacketPart::Length, 3} << 5 << 2;
        QTest::newRow("instruction") << Damage{PacketPart::Instruction} << 7 << 1;
        QTest::newRow("ERR") << Damage{PacketPart::Error} << 8 << 1;
        QTest::newRow("data") << Damage{PacketPart::Data, 4} << 9 << 3;
        QTest::newRow("CRC") << Damage{PacketPart::Crc, 16} << 12 << 2;
        QTest::newRow("anywhere") << Damage{PacketPart::Any, 9} << 0 << 14;
        QTest::newRow("a burst of 16") << Damage{PacketPart::Any, 1, 16} << 0 << 14;
        QTest::newRow("a burst in the ID") << Damage{PacketPart::Id, 1, 5, 3} << 4 << 1;
    }

    void damage()
    {
        QFETCH(Damage, damage);
        QFETCH(int, firstByte);
        QFETCH(int, bytes);
        Client client{*m_bus, 1'000'000};
        for (std::uint64_t seed = 1; seed < 50; ++seed) {
            m_bus->setFaults({.seed = seed, .replies = {{.kind = Kind::Damaged, .damage = damage}}});
            const Bytes heard = client.exchange(m_ping);
            QCOMPARE(heard.size(), m_answer.size());
            const auto turned = turnedBits(heard, m_answer);
            QVERIFY(!turned.empty());
            QVERIFY(turned.front() >= static_cast<std::size_t>(8 * firstByte));
            QVERIFY(turned.back() < static_cast<std::size_t>(8 * (firstByte + bytes)));
            if (damage.burst == 0)
                QCOMPARE(turned.size(), static_cast<std::size_t>(damage.bits));
            else
                QCOMPARE(turned.back() - turned.front(), static_cast<std::size_t>(damage.burst - 1));
            if (damage.firstBit >= 0)
                QCOMPARE(turned.front(), static_cast<std::size_t>(8 * firstByte + damage.firstBit));
            QCOMPARE(hex(client.exchange(m_ping)), hex(m_answer)); // one reply, no more
        }
    }

    /// What single faults make of the answers to a Ping of ID 1 and to a Sync Read of ID 1 to 3.
    void replies_data()
    {
        QTest::addColumn<ReplyFault>("fault");
        QTest::addColumn<QString>("ping");
        QTest::addColumn<QString>("read"); // Status packets "ID ERR data"; "+" others in hexadecimal
        const QString ping = QStringLiteral("01 00 FC 03 2D");
        const QString all = QStringLiteral("01 00 FC 03;02 00 FC 03;03 00 FC 03");
        QTest::newRow("lost") << ReplyFault{.kind = Kind::Lost} << ""
                              << "";
        QTest::newRow("the second lost") << ReplyFault{.kind = Kind::Lost, .skip = 1} << ping << "01 00 FC 03";
        QTest::newRow("the second lost at the adapter")
            << ReplyFault{.kind = Kind::Lost, .skip = 1, .atAdapter = true} << ping << "01 00 FC 03;03 00 FC 03";
        QTest::newRow("of ID 3") << ReplyFault{.kind = Kind::Lost, .id = 3} << ping << "01 00 FC 03;02 00 FC 03";
        QTest::newRow("wrong ID") << ReplyFault{.kind = Kind::WrongId, .amount = 9} << "09 00 FC 03 2D"
                                  << "09 00 FC 03";
        QTest::newRow("longer") << ReplyFault{.kind = Kind::WrongLength, .times = -1, .amount = 1}
                                << "01 00 FC 03 2D 00"
                                << "01 00 FC 03 00;02 00 FC 03 00;03 00 FC 03 00";
        QTest::newRow("shorter") << ReplyFault{.kind = Kind::WrongLength, .amount = -1} << "01 00 FC 03"
                                 << "01 00 FC;02 00 FC 03;03 00 FC 03";
        QTest::newRow("a stray one before")
            << ReplyFault{.kind = Kind::StrayBefore, .amount = 9} << "09 00 03 FC D2;01 00 FC 03 2D"
            << "09 00 03 FC;01 00 FC 03;02 00 FC 03;03 00 FC 03";
        const QString noise = QStringLiteral("+FF55;");
        QTest::newRow("noise before") << ReplyFault{.kind = Kind::NoiseBefore, .noise = {0xFF, 0x55}} << noise + ping
                                      << noise + all;
        QTest::newRow("twice") << ReplyFault{.kind = Kind::Twice} << ping + u';' + ping
                               << "01 00 FC 03;01 00 FC 03;02 00 FC 03;03 00 FC 03";
    }

    void replies()
    {
        QFETCH(ReplyFault, fault);
        QFETCH(QString, ping);
        QFETCH(QString, read);
        const auto bytes = [](const QString &text) {
            Bytes all;
            for (const QString &one : text.split(u';', Qt::SkipEmptyParts))
                all = join({all, one.startsWith(u'+') ? hex(one.mid(1)) : status(one)});
            return all;
        };
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.replies = {fault}});
        QCOMPARE(hex(client.exchange(m_ping)), hex(bytes(ping)));
        m_bus->setFaults({.replies = {fault}});
        QCOMPARE(hex(client.exchange(QStringLiteral("FE 82 00 00 02 00 01 02 03"))), hex(bytes(read)));
        m_bus->setFaults({});
        QCOMPARE(hex(client.exchange(m_ping)), hex(m_answer));
    }

    /// A device's piece of a fast reply is a reply of its own.
    void fastPieces_data()
    {
        QTest::addColumn<ReplyFault>("fault");
        QTest::addColumn<int>("bytes"); // of the packet that come
        QTest::addColumn<int>("good");  // first bytes that are as they should be
        // 8 bytes, then ERR ID data(2) CRC for each of three.
        QTest::newRow("healthy") << ReplyFault{.times = 0} << 26 << 26;
        QTest::newRow("second lost") << ReplyFault{.kind = Kind::Lost, .id = 2} << 14 << 14;
        QTest::newRow("second cut") << ReplyFault{.kind = Kind::Cut, .id = 2, .amount = 2} << 16 << 16;
        QTest::newRow("second's ERR") << ReplyFault{.kind = Kind::Damaged, .id = 2, .damage = {PacketPart::Error}} << 20
                                      << 14;
        QTest::newRow("second's ID") << ReplyFault{.kind = Kind::Damaged, .id = 2, .damage = {PacketPart::Id}} << 20
                                     << 15;
        QTest::newRow("second's CRC") << ReplyFault{.kind = Kind::Damaged, .id = 2, .damage = {PacketPart::Crc}} << 20
                                      << 18;
        QTest::newRow("the packet's LEN")
            << ReplyFault{.kind = Kind::Damaged, .damage = {PacketPart::Length, 1, 0, 0}} << 14 << 5;
        QTest::newRow("second under another ID") << ReplyFault{.kind = Kind::WrongId, .id = 2, .amount = 9} << 20 << 15;
        QTest::newRow("second too long") << ReplyFault{.kind = Kind::WrongLength, .id = 2, .amount = 1} << 21 << 18;
        QTest::newRow("second damaged at the adapter")
            << ReplyFault{.kind = Kind::Damaged, .id = 2, .damage = {PacketPart::Error}, .atAdapter = true} << 26 << 14;
    }

    void fastPieces()
    {
        QFETCH(ReplyFault, fault);
        QFETCH(int, bytes);
        QFETCH(int, good);
        Client client{*m_bus, 1'000'000};
        const QString request = QStringLiteral("FE 8A 00 00 02 00 01 02 03");
        const Bytes whole = client.exchange(request);
        m_bus->setFaults({.replies = {fault}});
        const Bytes heard = client.exchange(request);
        QCOMPARE(static_cast<int>(heard.size()), bytes);
        const auto differ = std::ranges::mismatch(heard, whole).in1 - heard.begin();
        QCOMPARE(static_cast<int>(differ), good);
        if (fault.kind == Kind::WrongId) // a block that is valid in itself
            QCOMPARE(oracle::crc(firstBytes(heard, 18)), static_cast<std::uint16_t>(heard[18] | heard[19] << 8));
    }

    void silentAndDeaf()
    {
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.silent = {1}, .deaf = {2, 3}});
        for (const int id : {1, 2, 3})
            QVERIFY(client.exchange(QStringLiteral("0%1 03 41 00 01").arg(id)).empty());
        QVERIFY(client.exchange(QStringLiteral("FE 01"), 900ms).empty());
        m_bus->setFaults({});
        for (const int id : {1, 2, 3})
            QCOMPARE(m_bus->servo(id, 1'000'000)->value(u"LED"), id == 1 ? 1 : 0);
        QCOMPARE(hex(client.exchange(m_ping)), hex(m_answer));
    }

    void rebootInsteadOfAnAnswer()
    {
        Client client{*m_bus, 1'000'000};
        client.exchange(QStringLiteral("01 03 41 00 01"));
        m_bus->setFaults({.replies = {{.kind = Kind::Reboot}}});
        QVERIFY(client.exchange(m_ping).empty());
        QVERIFY(client.exchange(m_ping).empty()); // boots
        QCOMPARE(m_bus->servos()[0]->value(u"LED"), 0);
        client.now += 400ms;
        QCOMPARE(hex(client.exchange(m_ping)), hex(m_answer));
    }

    void noiseStaysBetweenThePackets()
    {
        Client client{*m_bus, 1'000'000};
        m_bus->setFaults({.echo = {.on = true}, .noisePerSecond = 2000});
        std::size_t noise = 0;
        for (int i = 0; i < 500; ++i) {
            const Bytes heard = client.exchange(m_ping, 5ms);
            QVERIFY(contains(heard, m_ping));
            QVERIFY(contains(heard, m_answer));
            noise += heard.size() - m_ping.size() - m_answer.size();
        }
        QVERIFY2(noise > 4500 && noise < 5500, qPrintable(QString::number(noise))); // 500 × 5.1 ms
    }

    void aShareOfTheReplies()
    {
        Client client{*m_bus, 1'000'000};
        const auto pattern = [&](std::uint64_t seed) {
            m_bus->setFaults(
                {.seed = seed, .replies = {{.kind = Kind::Cut, .times = -1, .amount = -1, .share = 0.25}}});
            QString whole;
            for (int i = 0; i < 400; ++i)
                whole += client.exchange(m_ping, 2ms) == m_answer ? u'.' : u'x';
            return whole;
        };
        const QString first = pattern(1);
        QVERIFY2(first.count(u'x') > 70 && first.count(u'x') < 130, qPrintable(first));
        QCOMPARE(pattern(1), first);
        QVERIFY(pattern(2) != first);
    }

    void unpluggedAtEveryByteOfARequest()
    {
        const Bytes write = instruction(QStringLiteral("01 03 41 00 01"));
        for (std::size_t byte = 0; byte <= write.size(); ++byte) {
            m_bus = makeBus();
            SimulatedLine line(*m_bus, 1'000'000);
            m_bus->setFaults({.unplugAtSent = static_cast<int>(byte)});
            QVERIFY(line.write(write));
            Bytes heard;
            const auto read = line.read(heard, 50ms);
            QCOMPARE(read.has_value(), byte == write.size());
            m_bus->advanceTo(1s);
            QCOMPARE(m_bus->servos()[0]->value(u"LED"), byte == write.size() ? 1 : 0);
            if (read)
                continue;
            QCOMPARE(line.now(), static_cast<int>(byte) * ByteAt1M);
            QCOMPARE(line.write(write).error().kind, ErrorKind::PortLost);
            QCOMPARE(line.setBaudRate(57600).error().kind, ErrorKind::PortLost);
            m_bus->setFaults({});
            line.advance(1s);
            QVERIFY(line.write(write));
            QVERIFY(line.read(heard, line.now() + 50ms));
            QVERIFY(!heard.empty());
        }
    }

    void unpluggedAtEveryByteOfAReply()
    {
        for (std::size_t byte = 0; byte < m_answer.size(); ++byte) {
            m_bus = makeBus();
            SimulatedLine line(*m_bus, 1'000'000);
            m_bus->setFaults({.echo = {.on = true}, .unplugAtAnswered = static_cast<int>(byte)});
            QVERIFY(line.write(m_ping));
            Bytes heard;
            Result<void> read;
            while ((read = line.read(heard, 50ms)) && line.now() < 50ms) { }
            QVERIFY(!read);
            QCOMPARE(read.error().kind, ErrorKind::PortLost);
            QCOMPARE(hex(heard), hex(join({m_ping, firstBytes(m_answer, byte)})));
        }
    }

private:
    std::unique_ptr<SimulatedBus> makeBus()
    {
        auto bus = std::make_unique<SimulatedBus>(m_catalog);
        for (const int id : {1, 2, 3}) {
            if (!bus->add({QStringLiteral("XM430-W350"), -1, 1'000'000, id}))
                return nullptr;
        }
        return bus;
    }

    const Bytes m_ping = instruction(QStringLiteral("01 01"));
    const Bytes m_answer = status(QStringLiteral("01 00 FC 03 2D"));
    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<SimulatedBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestLineFaults)
#include "tst_linefaults.moc"
