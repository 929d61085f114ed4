// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/lateanswers.h"
#include "core/bus/messages.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

Result<Reply> came(std::uint8_t id)
{
    return Reply{id, DeviceError::None, false, {1, 2}, {}, 13};
}

Result<Reply> missing(std::uint8_t id)
{
    return tl::unexpected(messages::nothingReceived(id, 1ms));
}

ExchangeResult result(std::vector<Result<Reply>> replies)
{
    ExchangeResult all;
    all.replies = std::move(replies);
    return all;
}

} // namespace

class TestLateAnswers : public QObject
{
    Q_OBJECT

private slots:
    void whatMayStillCome()
    {
        LateAnswers late;
        QVERIFY(late.isEmpty());
        late.addMissing(readRequest({3, 132, 4}), result({missing(3)}), 5ms);
        QVERIFY(!late.isEmpty());
        QVERIFY(late.couldBe(3, 4, false));
        QVERIFY(!late.couldBe(3, 2, false)); // another length
        QVERIFY(!late.couldBe(4, 4, false)); // another device
        QVERIFY(late.couldBe(3, 0, true));   // an error comes without data
        QVERIFY(late.originOf(3, 4) == std::optional<LineTime>(5ms));
        QVERIFY(!late.originOf(3, 2));
        late.addMissing(readRequest({4, 132, 4}), result({came(4)}), 6ms);
        QVERIFY(!late.couldBe(4, 4, false));
    }

    void whatItConcerns_data()
    {
        QTest::addColumn<int>("id");
        QTest::addColumn<int>("length"); // of a Read; 0: Ping
        QTest::addColumn<bool>("concerned");
        QTest::newRow("the same again") << 3 << 4 << true;
        QTest::newRow("another length: an error looks alike") << 3 << 2 << true;
        QTest::newRow("Ping: its answer is longer") << 3 << 0 << false;
        QTest::newRow("another device") << 4 << 4 << false;
    }

    void whatItConcerns()
    {
        QFETCH(int, id);
        QFETCH(int, length);
        QFETCH(bool, concerned);
        LateAnswers late;
        late.addMissing(readRequest({3, 132, 4}), result({missing(3)}), 0ms);
        const auto device = static_cast<std::uint8_t>(id);
        const Request request
            = length > 0 ? readRequest({device, 0, static_cast<std::uint16_t>(length)}) : pingRequest(device);
        QCOMPARE(late.concern(request), concerned);
    }

    /// The answers of one request keep their order: those before the last that was heard won't come any more.
    void inAGroupOnlyThoseBehindTheLastHeard()
    {
        LateAnswers late;
        late.addMissing(syncReadRequest(132, 4, std::vector<std::uint8_t>{1, 2, 3, 4}, false),
                        result({missing(1), came(2), missing(3), missing(4)}), 0ms);
        QVERIFY(!late.couldBe(1, 4, false) && !late.couldBe(2, 4, false));
        QVERIFY(late.couldBe(3, 4, false) && late.couldBe(4, 4, false));
    }

    void fastRepliesAreKnownByTheirSize()
    {
        LateAnswers late;
        const Request request = syncReadRequest(132, 4, std::vector<std::uint8_t>{1, 2}, true);
        late.addMissing(request, result({came(1), missing(2)}), 0ms);
        QVERIFY(late.couldBeFast(request.maximumReplySize()));
        QVERIFY(!late.couldBeFast(request.maximumReplySize() + 1));
        QVERIFY(late.concern(request));
        QVERIFY(!late.couldBe(1, 4, false) && !late.couldBe(2, 4, false));
    }

    /// What proves that nothing older is under way; but whoever is told to write takes its time.
    void anAnswerClears()
    {
        LateAnswers late;
        late.addMissing(readRequest({3, 132, 4}), result({missing(3)}), 0ms);
        late.addMissing(pingRequest(5), result({missing(5)}), 0ms);
        late.addMissing(writeRequest({6, 7, {1}}), result({missing(6)}), 0ms);
        late.clear(9, 1ms);
        QVERIFY(!late.couldBe(3, 4, false) && !late.couldBePing(5));
        QVERIFY(late.couldBe(6, 0, false));
        late.clear(9, 1s);
        QVERIFY(late.isEmpty());
        late.addMissing(writeRequest({6, 7, {1}}), result({missing(6)}), 2s);
        late.clear(6, 2s); // its own answer
        QVERIFY(late.isEmpty());
    }

    void nothingIsLateForEver()
    {
        LateAnswers late;
        late.addAll(readRequest({3, 132, 4}), 1s);
        late.forgetOld(1s + LateAnswers::Longest);
        QVERIFY(!late.isEmpty());
        late.forgetOld(1s + LateAnswers::Longest + 1ns);
        QVERIFY(late.isEmpty());
    }

    void pingsAtAnotherRate()
    {
        LateAnswers late;
        late.addPings(0ms);
        late.addAll(pingRequest(5), 0ms);
        QVERIFY(late.couldBePing(7) && late.couldBePing(5));
        QVERIFY(!late.couldFakePing(5)); // it says what any Ping's answer says
        QVERIFY(!late.concern(pingRequest(5)));
        late.rateChanged(); // it says who was there at the old one
        QVERIFY(!late.couldBePing(7));
        QVERIFY(late.couldFakePing(5) && late.concern(pingRequest(5)));
    }

    void aLengthThatNothingElseHas()
    {
        LateAnswers late;
        QCOMPARE(late.distinctLength(3), std::uint16_t(2));
        late.addAll(readRequest({3, 0, 2}), 0ms);
        QCOMPARE(late.distinctLength(3), std::uint16_t(4)); // 3 is a Ping's
        QCOMPARE(late.distinctLength(4), std::uint16_t(2));
        for (std::uint16_t length = 1; length < 200; ++length)
            late.addAll(readRequest({3, 0, length}), 0ms);
        QCOMPARE(late.distinctLength(3), std::uint16_t(0));
    }
};

DYNASCOPE_CORE_TEST(TestLateAnswers)
#include "tst_lateanswers.moc"
