// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/lateanswers.h"
#include "core/bus/learnedtiming.h"
#include "core/bus/poller.h"
#include "tests/support/fakeservos.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

/// How long an answer is waited for, and which late ones are reckoned with.
class TestLearnedTiming : public QObject
{
    Q_OBJECT

private slots:
    void believesTheLineUntilItHasSeenEnough()
    {
        LearnedTiming timing;
        QCOMPARE(timing.allowance(1, 21ms), LineTime(21ms));
        for (int i = 0; i < 100; ++i)
            timing.learn(1, 300us);
        QVERIFY(timing.allowance(1, 21ms) < 3ms);
        QVERIFY(timing.allowance(1, 21ms) >= 2ms);
        QVERIFY(timing.allowance(2, 21ms) < 3ms); // what the line is like holds for a new device, too
        QVERIFY(timing.allowance(1, 0ms) < 310us); // a line without delays of its own has no jitter
    }

    void oneOutlierIsAStep()
    {
        LearnedTiming timing;
        for (int i = 0; i < 100; ++i)
            timing.learn(1, 300us);
        timing.learn(1, 10s);
        QVERIFY(timing.allowance(1, 21ms) < 20ms);
        for (int i = 0; i < 100; ++i)
            timing.learn(1, 10s);
        QVERIFY(timing.allowance(1, 21ms) <= LearnedTiming::Longest); // whatever is seen
    }

    void missedOftenItBelievesTheLineAgain()
    {
        LearnedTiming timing;
        for (int i = 0; i < 100; ++i)
            timing.learn(1, 300us);
        for (int i = 0; i < 3; ++i)
            timing.missed(1);
        QCOMPARE(timing.allowance(1, 21ms), LineTime(21ms));
        timing.learn(1, 300us);
        QVERIFY(timing.allowance(1, 21ms) < 3ms);
    }

    void missedOftenWhileOthersAnswerItIsMissing()
    {
        LearnedTiming timing;
        for (int i = 0; i < 100; ++i) {
            timing.learn(1, 300us);
            timing.learn(2, 300us);
        }
        for (int i = 0; i < 3; ++i) {
            timing.missed(1);
            timing.missed(3); // was never there
        }
        QCOMPARE(timing.allowance(1, 21ms), LineTime(21ms));
        QCOMPARE(timing.allowance(3, 21ms), LineTime(21ms));
        for (int i = 0; i < 8; ++i)
            timing.learn(2, 300us);
        QVERIFY(timing.allowance(1, 21ms) < 3ms);
        QVERIFY(timing.allowance(3, 21ms) < 3ms);
        for (int i = 0; i < 8; ++i)
            timing.learn(2, 9ms); // in time or behind it: the adapter did become slower
        QVERIFY(timing.allowance(1, 21ms) > 9ms);
    }

    // Five of eight that stand in the list are not there, and the line might be slow.
    void absentDevicesCostWhatTheLineIsLike()
    {
        FakeLine line;
        line.allowance = 50ms;
        FakeServos servos(line);
        PollPlan plan;
        for (const std::uint8_t id : {1, 2, 3, 4, 5, 6, 7, 8}) {
            if (id < 4)
                servos.servos[id];
            Traits traits;
            traits.id = id;
            plan.traits.push_back(traits);
            plan.spans.push_back({id, {id, 132, 4}, 0ms});
        }
        Bus bus(line);
        Poller poller(bus);
        poller.setPlan(plan);
        const auto cyclesIn = [&](LineTime duration) {
            int cycles = 0;
            for (const LineTime end = line.now() + duration; line.now() < end; ++cycles) {
                if (!poller.runCycle())
                    return -1;
            }
            return cycles;
        };
        const int first = cyclesIn(1s);
        const int second = cyclesIn(1s);
        const int tenth = cyclesIn(9s) / 9;
        qInfo("%d, %d and %d a second", first, second, tenth);
        QVERIFY(first >= 4); // nothing is known of the line yet
        QVERIFY(second > 250);
        QVERIFY(tenth > 400);
    }

    // An adapter that turns slow in mid-poll (its latency timer set back, a busy network) loses nobody for good.
    void anAdapterThatTurnsSlowIsFollowed()
    {
        FakeLine line;
        line.allowance = 60ms;
        FakeServos servos(line);
        PollPlan plan;
        for (const std::uint8_t id : {1, 2, 3}) {
            servos.servos[id].registers[132] = id;
            Traits traits;
            traits.id = id;
            plan.traits.push_back(traits);
            plan.spans.push_back({id, {id, 132, 4}, 0ms});
        }
        LineTime late{};
        const FakeLine::Handler answer = line.handler;
        line.handler = [&](const Bytes &request) {
            FakeLine::Answer pieces = answer(request);
            for (FakeLine::Piece &piece : pieces)
                piece.delay += late;
            return pieces;
        };
        Bus bus(line);
        Poller poller(bus);
        poller.setPlan(plan);
        Batch batch;
        const auto missing = [&] {
            if (!poller.runCycle(batch))
                return -1;
            return static_cast<int>(std::ranges::count_if(batch.values, [](const auto &value) { return value.data.empty(); }));
        };
        for (int i = 0; i < 200; ++i)
            QCOMPARE(missing(), 0);
        late = 30ms;
        const LineTime begin = line.now();
        for (int whole = 0; whole < 20;) {
            const LineTime due = std::max(poller.nextDue(), line.now());
            Bytes ignored;
            while (line.now() < due)
                QVERIFY(line.read(ignored, due));
            whole = missing() == 0 && batch.values.size() == 3 ? whole + 1 : 0;
            QVERIFY2(line.now() < begin + 10s, "still not all of them");
        }
    }

    void whatALateAnswerCanBe()
    {
        LateAnswers late;
        const Request read = readRequest({3, 132, 4});
        QVERIFY(!late.concern(read));
        late.addAll(read, 1s);
        QVERIFY(late.concern(read));
        QVERIFY(late.couldBe(3, 4, false) && !late.couldBe(3, 5, false) && !late.couldBe(4, 4, false));
        QVERIFY(late.couldBe(3, 0, true)); // a refusal comes without data
        QVERIFY(!late.concern(pingRequest(3)));
        QVERIFY(!late.couldBePing(3));
        late.clear(3, 1s);
        QVERIFY(late.isEmpty());
    }

    void aReadOfThreeBytesLooksLikeAPing()
    {
        LateAnswers late;
        late.addAll(readRequest({3, 132, 3}), 1s);
        QVERIFY(late.couldFakePing(3) && late.concern(pingRequest(3)));
        QCOMPARE(late.distinctLength(3), std::uint16_t(2));
        late.addAll(readRequest({3, 0, 2}), 1s);
        QCOMPARE(late.distinctLength(3), std::uint16_t(4));
    }

    void aPingAtAnotherRateSaysNothing()
    {
        LateAnswers late;
        late.addAll(pingRequest(3), 1s);
        late.addPings(1s);
        QVERIFY(!late.concern(pingRequest(3)));
        late.rateChanged();
        QVERIFY(late.concern(pingRequest(3)));
        QVERIFY(!late.concern(pingRequest(4)));
    }

    void aSlowDeviceMayAnswerBehindAnother()
    {
        LateAnswers late;
        late.addAll(clearRequest(3, ClearOption::Position), 1s);
        late.clear(5, 2s); // it may take 3 s
        QVERIFY(late.concern(writeRequest({3, 64, {1}})));
        late.clear(5, 5s);
        QVERIFY(late.isEmpty());
    }

    void nobodyWaitsForEver()
    {
        LateAnswers late;
        late.addAll(readRequest({3, 132, 4}), 1s);
        late.forgetOld(2s);
        QVERIFY(!late.isEmpty());
        late.forgetOld(12s);
        QVERIFY(late.isEmpty());
    }
};

DYNASCOPE_CORE_TEST(TestLearnedTiming)
#include "tst_learnedtiming.moc"
