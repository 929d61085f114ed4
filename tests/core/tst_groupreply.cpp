// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/groupreply.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

class TestGroupReply : public QObject
{
    Q_OBJECT

private slots:
    /// The manual's worked Fast Bulk Read: three devices, three lengths, one packet.
    void fastBulkReadPieceByPiece()
    {
        Chain chain;
        chain.group = {{{3, 0x84, 4}, {7, 0x7C, 2}, {4, 0x92, 1}}, true};
        const StatusPacket blocks[] = {{3, DeviceError::None, false, {0xA6, 0, 0, 0}},
                                       {7, DeviceError::None, false, {0xA5, 0x01}},
                                       {4, DeviceError::None, false, {0x1F}}};
        const char *pieces[] = {"FF FF FD 00 FE 14 00 55 00 03 A6 00 00 00 67 A4", "00 07 A5 01 24 74",
                                "00 04 1F D9 C1"};
        for (std::size_t i = 0; i < 3; ++i) {
            const StatusPacket &block = blocks[i];
            QCOMPARE(hex(chainBytes(chain, i, block)), QString::fromLatin1(pieces[i]));
        }
    }

    void pingSlots_data()
    {
        QTest::addColumn<QList<int>>("ids");
        QTest::addColumn<QList<int>>("milliseconds");
        QTest::newRow("ID 0 at once") << QList<int>{0} << QList<int>{0};
        QTest::newRow("ID 1 after one empty slot") << QList<int>{1} << QList<int>{3};
        QTest::newRow("two neighbours") << QList<int>{0, 1} << QList<int>{0, 2};
        QTest::newRow("a hole between") << QList<int>{0, 3} << QList<int>{0, 8};
        QTest::newRow("one ID twice") << QList<int>{1, 1, 2} << QList<int>{3, 3, 5};
        QTest::newRow("the last") << QList<int>{252} << QList<int>{756};
    }

    void pingSlots()
    {
        QFETCH(QList<int>, ids);
        QFETCH(QList<int>, milliseconds);
        std::vector<PingSlot> pings;
        for (const int id : ids)
            pings.push_back({static_cast<std::uint8_t>(id), 0ms, 2ms});
        const auto times = pingTimes(100ms, pings);
        for (qsizetype i = 0; i < ids.size(); ++i)
            QCOMPARE(times[static_cast<std::size_t>(i)], LineTime(100ms + std::chrono::milliseconds(milliseconds[i])));
    }
};

DYNASCOPE_CORE_TEST(TestGroupReply)
#include "tst_groupreply.moc"
