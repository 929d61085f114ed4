// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

namespace {

/// The answers of several devices, one after the other.
Bytes statuses(const QString &semicolonSeparated)
{
    Bytes all;
    for (const QString &one : semicolonSeparated.split(u';', Qt::SkipEmptyParts)) {
        const Bytes packet = status(one);
        all.insert(all.end(), packet.begin(), packet.end());
    }
    return all;
}

constexpr LineTime ByteAt57600 = LineTime(10'000'000'000LL / 57600);

} // namespace

/// Several servos on one wire: who speaks, when, and what becomes of it.
class TestSimulatedBus : public QObject
{
    Q_OBJECT

private slots:
    void groupReads_data()
    {
        QTest::addColumn<QString>("devices"); // IDs on the wire
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answers");

        QTest::newRow("Sync Read, all there") << "1,2" << "" << "FE 82 07 00 01 00 01 02" << "01 00 01;02 00 02";
        QTest::newRow("in the order of the request") << "1,2" << "" << "FE 82 07 00 01 00 02 01" << "02 00 02;01 00 01";
        QTest::newRow("one missing silences all behind it") << "1,2,3" << "" << "FE 82 07 00 01 00 01 09 02 03"
                                                            << "01 00 01";
        QTest::newRow("the first missing silences all") << "1,2" << "" << "FE 82 07 00 01 00 09 01 02" << "";
        QTest::newRow("the last missing silences nobody") << "1,2" << "" << "FE 82 07 00 01 00 01 02 09"
                                                          << "01 00 01;02 00 02";
        QTest::newRow("an error does not break the chain") << "1,2" << "" << "FE 82 95 02 02 00 01 02"
                                                           << "01 07;02 07";
        QTest::newRow("level 0 breaks it") << "1,2" << "01 03 44 00 00" << "FE 82 07 00 01 00 01 02" << "";
        QTest::newRow("Bulk Read") << "1,2" << "" << "FE 92 01 07 00 01 00 02 44 00 01 00" << "01 00 01;02 00 02";
        QTest::newRow("Bulk Read, one missing") << "1,2" << "" << "FE 92 09 07 00 01 00 02 44 00 01 00" << "";
        QTest::newRow("a group read is for everyone") << "1,2" << "" << "01 82 07 00 01 00 01 02" << "";
    }

    void groupReads()
    {
        QFETCH(QString, devices);
        QFETCH(QString, before);
        QFETCH(QString, request);
        QFETCH(QString, answers);
        SimulatedBus bus(m_catalog);
        for (const QString &id : devices.split(u','))
            QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, id.toInt()}));
        Client client{bus};
        client.exchangeAll(before);
        QCOMPARE(hex(client.exchange(request)), hex(statuses(answers)));
    }

    void fastReads_data()
    {
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answer");
        // The manual's worked example, byte for byte; and the same asked for by Fast Bulk Read, there without its CRC.
        const QString reply = QStringLiteral("FF FF FD 00 FE 19 00 55 00 03 A6 00 00 00 84 08 "
                                             "00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00 D1 9E");
        QTest::newRow("sync") << "FF FF FD 00 FE 0A 00 8A 84 00 04 00 03 07 04 20 F2" << reply;
        QTest::newRow("bulk") << "FF FF FD 00 FE 12 00 9A 03 84 00 04 00 07 84 00 04 00 04 84 00 04 00" << reply;
    }

    void fastReads()
    {
        QFETCH(QString, request);
        QFETCH(QString, answer);
        SimulatedBus bus(m_catalog);
        const std::pair<int, double> positions[] = {{3, 166}, {7, 2079}, {4, 1023}};
        for (const auto &[id, pulses] : positions) {
            auto servo = bus.add({QStringLiteral("XM430-W350"), -1, 57600, id});
            QVERIFY(servo);
            (*servo)->joint().setShaftAngle(pulses * 360 / 4096);
        }
        Client client{bus};
        Bytes packet = hex(request);
        if (packet.size() == 23) { // written without its CRC
            const std::uint16_t sum = oracle::crc(packet);
            packet.push_back(static_cast<std::uint8_t>(sum & 0xFF));
            packet.push_back(static_cast<std::uint8_t>(sum >> 8));
        }
        QCOMPARE(hex(client.exchange(packet)), hex(hex(answer)));
    }

    void fastReadsThatBreak_data()
    {
        QTest::addColumn<QString>("ids");
        QTest::addColumn<int>("bytes"); // of the packet that come
        QTest::newRow("all there") << "01 02" << 8 + 2 * 5;
        QTest::newRow("the second missing") << "01 09 02" << 8 + 5;
        QTest::newRow("the first missing") << "09 01 02" << 0;
        QTest::newRow("firmware that can't") << "01 03 02" << 8 + 5;
    }

    void fastReadsThatBreak()
    {
        QFETCH(QString, ids);
        QFETCH(int, bytes);
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 2}));
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), 44, 57600, 3}));
        Client client{bus};
        const Bytes heard = client.exchange(QStringLiteral("FE 8A 07 00 01 00 ") + ids);
        QCOMPARE(static_cast<int>(heard.size()), bytes);
        if (bytes == 0)
            return;
        const auto listed = static_cast<int>(hex(ids).size());
        QCOMPARE(static_cast<int>(heard[5]), 1 + listed * 5); // LEN is of the whole packet
        const Bytes first(heard.begin(), heard.begin() + 11);
        QCOMPARE(oracle::crc(first), static_cast<std::uint16_t>(heard[11] | heard[12] << 8));
    }

    void broadcastPing()
    {
        SimulatedBus bus(m_catalog);
        for (const int id : {9, 2, 5})
            QVERIFY(bus.add({QStringLiteral("XL430-W250"), -1, 57600, id}));
        Client client{bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("FE 01"), 900ms)),
                 hex(statuses(QStringLiteral("02 00 24 04 2D;05 00 24 04 2D;09 00 24 04 2D"))));
        // IDs 0 and 1 are absent: two slots of 3 ms, then delay, then one byte.
        QCOMPARE(client.firstByte, 2 * 3ms + 100us + 500us + ByteAt57600);
    }

    void returnDelay_data()
    {
        QTest::addColumn<QString>("before");
        QTest::addColumn<int>("microseconds");
        QTest::newRow("factory") << "" << 600;
        QTest::newRow("0") << "01 03 09 00 00" << 100;
        QTest::newRow("254") << "01 03 09 00 FE" << 608;
    }

    void returnDelay()
    {
        QFETCH(QString, before);
        QFETCH(int, microseconds);
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        client.exchangeAll(before);
        QVERIFY(!client.exchange(QStringLiteral("01 01")).empty());
        QCOMPARE(client.firstByte, std::chrono::microseconds(microseconds) + ByteAt57600);
    }

    void aGapInsideAPacketLosesIt_data()
    {
        QTest::addColumn<int>("microseconds");
        QTest::addColumn<bool>("answered");
        QTest::newRow("1.4 ms") << 1400 << true;
        QTest::newRow("1.6 ms") << 1600 << false;
    }

    void aGapInsideAPacketLosesIt()
    {
        QFETCH(int, microseconds);
        QFETCH(bool, answered);
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        const Bytes ping = instruction(QStringLiteral("01 01"));
        bus.send(ByteView(ping).first(5), client.now, client.baudRate);
        client.now += 5 * ByteAt57600 + std::chrono::microseconds(microseconds);
        QCOMPARE(!client.exchange(Bytes(ping.begin() + 5, ping.end())).empty(), answered);
    }

    void twoRatesHearGarbage()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 1000000, 2}));
        Client slow{bus};
        QCOMPARE(hex(slow.exchange(QStringLiteral("01 01"))), hex(status(QStringLiteral("01 00 FC 03 2D"))));
        QVERIFY(slow.exchange(QStringLiteral("02 01")).empty());
        Client fast{bus, 1000000, slow.now};
        QCOMPARE(hex(fast.exchange(QStringLiteral("02 01"))), hex(status(QStringLiteral("02 00 FC 03 2D"))));
        QVERIFY(fast.exchange(QStringLiteral("01 01")).empty());
        // The answer of one that the controller listens to at another rate: something, but not a packet.
        const Bytes ping = instruction(QStringLiteral("02 01"));
        bus.send(ping, fast.now, 1000000);
        Bytes heard;
        bus.receive(heard, fast.now + 20ms, 115200);
        QVERIFY(!heard.empty());
        QVERIFY(heard != status(QStringLiteral("02 00 FC 03 2D")));
    }

    void nearlyTheSameRateIsUnderstood()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 4500000, 1}));
        Client client{bus, 4571428};
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))), hex(status(QStringLiteral("01 00 FC 03 2D"))));
    }

    void aBaudChangeAnswersAtTheOldRate()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("01 03 08 00 03"))), hex(status(QStringLiteral("01 00"))));
        QVERIFY(client.exchange(QStringLiteral("01 01")).empty());
        client.baudRate = 1000000;
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))), hex(status(QStringLiteral("01 00 FC 03 2D"))));
    }

    void twoDevicesWithOneId()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))), hex(status(QStringLiteral("01 00 FC 03 2D"))));
        bus.servos()[1]->joint().setShaftAngle(10);
        const Bytes heard = client.exchange(QStringLiteral("01 02 84 00 04 00"));
        QCOMPARE(heard.size(), std::size_t(15));
        const std::uint16_t sum = oracle::crc(Bytes(heard.begin(), heard.end() - 2));
        QVERIFY(sum != (heard[13] | heard[14] << 8));
    }

    void differentReturnDelaysGiveTwoAnswers()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 4000000, 1}));
        auto second = bus.add({QStringLiteral("XM430-W350"), -1, 4000000, 1});
        QVERIFY(second);
        QCOMPARE((*second)->write(u"Return Delay Time", 0), DeviceError::None);
        Client client{bus, 4000000};
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))),
                 hex(statuses(QStringLiteral("01 00 FC 03 2D;01 00 FC 03 2D"))));
    }

    void anInstructionDuringAnAnswerSpoilsBoth()
    {
        SimulatedBus bus(m_catalog);
        auto servo = bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1});
        QVERIFY(servo);
        Client client{bus};
        const Bytes read = instruction(QStringLiteral("01 02 84 00 04 00"));
        bus.send(read, client.now, client.baudRate);
        client.now += static_cast<int>(read.size() + 5) * ByteAt57600; // in the middle of the answer
        const Bytes heard = client.exchange(QStringLiteral("01 03 41 00 01"));
        QVERIFY(!heard.empty());
        QCOMPARE((*servo)->value(u"LED"), 0);
    }

    void anInstructionEndsTheChain()
    {
        SimulatedBus bus(m_catalog);
        for (const int id : {1, 2, 3})
            QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 1000000, id}));
        Client client{bus, 1000000};
        const Bytes read = instruction(QStringLiteral("FE 82 07 00 01 00 01 02 03"));
        bus.send(read, client.now, client.baudRate);
        client.now += 170us; // just gone: the delays of 500 us run
        const Bytes heard = client.exchange(QStringLiteral("FE 83 41 00 01 00 01 01 02 01 03 01"));
        QCOMPARE(hex(heard), QString()); // the first in the chain gave up as well
        for (const auto &servo : bus.servos())
            QCOMPARE(servo->value(u"LED"), 1);
    }

    void faults()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        const Bytes whole = status(QStringLiteral("01 00 FC 03 2D"));
        bus.setFaults({.replies = {{.kind = ReplyFault::Kind::Lost}}});
        QVERIFY(client.exchange(QStringLiteral("01 01")).empty());
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))), hex(whole));
        bus.setFaults({.replies = {{.kind = ReplyFault::Kind::Damaged}}});
        const Bytes damaged = client.exchange(QStringLiteral("01 01"));
        QCOMPARE(damaged.size(), whole.size());
        QVERIFY(damaged != whole);
        bus.setFaults({.replies = {{.kind = ReplyFault::Kind::Late, .time = 5ms}}});
        QCOMPARE(hex(client.exchange(QStringLiteral("01 01"))), hex(whole));
        QCOMPARE(client.firstByte, 5ms + 600us + ByteAt57600);
    }

    void theLogHasWhatStoodOnTheWire()
    {
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        bus.setLogging(true);
        Client client{bus};
        const Bytes ping = instruction(QStringLiteral("01 01"));
        const Bytes answer = client.exchange(ping);
        QCOMPARE(bus.log().size(), std::size_t(2));
        QVERIFY(bus.log()[0].fromController);
        QCOMPARE(hex(bus.log()[0].bytes), hex(ping));
        QCOMPARE(bus.log()[0].end, 10 * ByteAt57600);
        QVERIFY(!bus.log()[1].fromController);
        QCOMPARE(hex(bus.log()[1].bytes), hex(answer));
        QCOMPARE(bus.log()[1].begin, 10 * ByteAt57600 + 600us);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestSimulatedBus)
#include "tst_simulatedbus.moc"
