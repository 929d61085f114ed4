// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/timing.h"
#include "tests/support/fakeline.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

class TestTiming : public QObject
{
    Q_OBJECT

private slots:
    void processing_data()
    {
        QTest::addColumn<int>("instruction");
        QTest::addColumn<qint64>("least"); // ms
        QTest::addColumn<qint64>("most");
        const auto row = [](const char *name, Instruction instruction, qint64 least, qint64 most) {
            QTest::newRow(name) << static_cast<int>(instruction) << least << most;
        };
        row("Ping", Instruction::Ping, 0, 1);
        row("Read", Instruction::Read, 0, 1);
        row("Sync Read", Instruction::SyncRead, 0, 1);
        row("Fast Bulk Read", Instruction::FastBulkRead, 0, 1);
        row("Write: EEPROM", Instruction::Write, 20, 100);
        row("Reg Write", Instruction::RegWrite, 20, 100);
        row("Action", Instruction::Action, 20, 100);
        row("Reboot", Instruction::Reboot, 100, 1000);
        row("Factory Reset", Instruction::FactoryReset, 100, 1000);
        row("Clear: seconds", Instruction::Clear, 2000, 5000);
        row("Backup: seconds", Instruction::ControlTableBackup, 2000, 5000);
    }

    void processing()
    {
        QFETCH(int, instruction);
        QFETCH(qint64, least);
        QFETCH(qint64, most);
        const LineTime time = timing::processing(static_cast<Instruction>(instruction));
        QVERIFY(time > 0ms);
        QVERIFY(time >= least * 1ms && time <= most * 1ms);
    }

    /// 1.5 ms, or ten bytes where they take longer.
    void silence()
    {
        QCOMPARE(timing::silence(FakeLine(1'000'000)), LineTime(1500us));
        QCOMPARE(timing::silence(FakeLine(57'600)).count(), (10 * FakeLine(57'600).byteTime()).count());
        QVERIFY(timing::silence(FakeLine(9'600)) > 10ms);
    }

    /// No status packet of so many parameters is longer, and there is one that is as long.
    void largestStatus()
    {
        for (std::size_t count = 0; count <= 12; ++count) {
            std::size_t longest = 0;
            for (std::size_t phase = 0; phase < 3; ++phase) { // FF FF FD again and again, from each of its bytes on
                Bytes data;
                for (std::size_t i = 0; i < count; ++i)
                    data.push_back((i + phase) % 3 == 2 ? 0xFD : 0xFF);
                longest = std::max(longest, oracle::status(1, 0xFF, data).size());
            }
            QVERIFY(longest <= timing::largestStatus(count));
            QVERIFY(timing::largestStatus(count) <= longest + 1);
        }
    }

    /// The request's own echo, each reply with its stuffing, and one of another length fit in; a wild length doesn't.
    void largestPacket()
    {
        const Request read = readRequest({1, 132, 100});
        QVERIFY(timing::largestPacket(read, 14) >= timing::largestStatus(100));
        QVERIFY(timing::largestPacket(read, 14) < 300);
        QVERIFY(timing::largestPacket(writeRequest({1, 0, Bytes(500)}), 512) >= 512);
        const Request fast = syncReadRequest(132, 100, std::vector<std::uint8_t>{1, 2, 3}, true);
        QVERIFY(timing::largestPacket(fast, 17) >= fast.maximumReplySize());
        const Request bulk = bulkReadRequest(std::vector<Span>{{1, 0, 2}, {2, 0, 200}, {3, 0, 4}}, false);
        QVERIFY(timing::largestPacket(bulk, 30) >= timing::largestStatus(200)); // any of them, not all
        QVERIFY(timing::largestPacket(bulk, 30) < timing::largestStatus(200) + 100);
    }
};

DYNASCOPE_CORE_TEST(TestTiming)
#include "tst_timing.moc"
