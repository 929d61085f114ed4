// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/requests.h"
#include "core/protocol/parser.h"
#include "tests/support/hex.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

template <typename T>
T decoded(const Request &request)
{
    const auto command = decodeCommand(request.packet);
    return command && std::holds_alternative<T>(*command) ? std::get<T>(*command) : T{};
}

DeviceError refusal(Instruction instruction, const char *parameters)
{
    const auto command = decodeCommand({1, instruction, hex::bytes(parameters)});
    return command ? DeviceError::None : command.error();
}

} // namespace

class TestRequests : public QObject
{
    Q_OBJECT

private slots:
    void aDeviceUnderstandsTheController()
    {
        const auto read = decoded<ReadCommand>(readRequest({1, 132, 10}));
        QCOMPARE(read.address, 132);
        QCOMPARE(read.length, 10);
        const auto write = decoded<WriteCommand>(writeRequest({1, 64, {1}}));
        QCOMPARE(write.address, 64);
        QCOMPARE(write.data, Bytes{1});
        QVERIFY(!write.registered);
        QVERIFY(decoded<WriteCommand>(regWriteRequest({1, 64, {1}})).registered);
        QCOMPARE(decoded<FactoryResetCommand>(factoryResetRequest(1, ResetOption::AllButIdAndBaud)).option,
            ResetOption::AllButIdAndBaud);
        QCOMPARE(decoded<ClearCommand>(clearRequest(1, ClearOption::Error)).option, ClearOption::Error);
        QCOMPARE(decoded<BackupCommand>(backupRequest(1, BackupOption::Restore)).option, BackupOption::Restore);
        QVERIFY(std::holds_alternative<RebootCommand>(*decodeCommand(rebootRequest(1).packet)));
        QVERIFY(std::holds_alternative<ActionCommand>(*decodeCommand(actionRequest(1).packet)));
        QVERIFY(std::holds_alternative<PingCommand>(*decodeCommand(pingRequest(1).packet)));
    }

    void groupsKeepTheirOrder()
    {
        const std::vector<Span> spans{{7, 132, 4}, {3, 64, 1}, {252, 0, 120}};
        for (const bool fast : {false, true}) {
            const auto bulk = decoded<GroupReadCommand>(bulkReadRequest(spans, fast));
            QCOMPARE(bulk.spans, spans);
            QCOMPARE(bulk.fast, fast);
            const std::vector<std::uint8_t> ids{9, 2, 5};
            const auto sync = decoded<GroupReadCommand>(syncReadRequest(100, 2, ids, fast));
            QCOMPARE(sync.spans, (std::vector<Span>{{9, 100, 2}, {2, 100, 2}, {5, 100, 2}}));
        }
        const std::vector<SpanData> same{{4, 116, {1, 2, 3, 4}}, {2, 116, {5, 6, 7, 8}}};
        QCOMPARE(decoded<GroupWriteCommand>(syncWriteRequest(same)).writes, same);
        const std::vector<SpanData> mixed{{4, 116, {1, 2, 3, 4}}, {2, 64, {0}}};
        QCOMPARE(decoded<GroupWriteCommand>(bulkWriteRequest(mixed)).writes, mixed);
    }

    void saysWhoAnswers()
    {
        QCOMPARE(pingRequest(1).shape, ReplyShape::Single);
        QCOMPARE(pingRequest(BroadcastId).shape, ReplyShape::Anyone);
        QCOMPARE(writeRequest({BroadcastId, 64, {0}}).shape, ReplyShape::None);
        QCOMPARE(rebootRequest(BroadcastId).shape, ReplyShape::None);
        QCOMPARE(readRequest({3, 132, 4}).replies, (std::vector<ExpectedReply>{{3, 4}}));
        const std::vector<std::uint8_t> ids{9, 2};
        QCOMPARE(syncReadRequest(100, 2, ids, true).shape, ReplyShape::Fast);
        QCOMPARE(syncReadRequest(100, 2, ids, false).replies, (std::vector<ExpectedReply>{{9, 2}, {2, 2}}));
    }

    void repeatsOnlyWhatBearsIt()
    {
        QVERIFY(readRequest({1, 0, 1}).isIdempotent());
        QVERIFY(writeRequest({1, 64, {1}}).isIdempotent());
        QVERIFY(!actionRequest(1).isIdempotent());
        QVERIFY(!regWriteRequest({1, 64, {1}}).isIdempotent());
        QVERIFY(!rebootRequest(1).isIdempotent());
        QVERIFY(!factoryResetRequest(1, ResetOption::AllButId).isIdempotent());
        QVERIFY(!clearRequest(1, ClearOption::Position).isIdempotent());
        QVERIFY(!backupRequest(1, BackupOption::Store).isIdempotent());
    }

    void boundsTheReply()
    {
        // A status whose data is all patterns, stuffed.
        Bytes data;
        for (int i = 0; i < 40; ++i) {
            const Bytes pattern = hex::bytes("FF FF FD");
            data.insert(data.end(), pattern.begin(), pattern.end());
        }
        const std::size_t size = encode(StatusPacket{1, DeviceError::None, false, data}).size();
        QVERIFY(readRequest({1, 0, static_cast<std::uint16_t>(data.size())}).maximumReplySize() >= size);
        QCOMPARE(syncReadRequest(0, 4, std::vector<std::uint8_t>{1, 2, 3}, true).maximumReplySize(), std::size_t(32));
    }

    void refusesAsADeviceDoes()
    {
        QCOMPARE(refusal(Instruction::Read, "84 00 04"), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::Write, "84 00"), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::FactoryReset, ""), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::FactoryReset, "03"), DeviceError::DataRange);
        QCOMPARE(refusal(Instruction::Clear, "01 44 58 4C 23"), DeviceError::DataRange);
        QCOMPARE(refusal(Instruction::Clear, "01 44"), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::ControlTableBackup, "03 43 54 52 4C"), DeviceError::DataRange);
        QCOMPARE(refusal(Instruction::SyncRead, "84 00"), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::BulkRead, "01 84 00 04"), DeviceError::DataLength);
        QCOMPARE(refusal(Instruction::BulkWrite, "01 84 00 04 00 11"), DeviceError::DataLength);
        QCOMPARE(refusal(static_cast<Instruction>(0x77), ""), DeviceError::Instruction);
        QCOMPARE(refusal(Instruction::Status, ""), DeviceError::Instruction);
    }
};

DYNASCOPE_CORE_TEST(TestRequests)
#include "tst_requests.moc"
