// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/ratelimit.h"
#include "tests/support/testmain.h"

#include <algorithm>

using namespace dynascope;
using namespace std::chrono_literals;
using What = RateLimit::What;

namespace {

/// Three devices of which the position is read.
PolledLine three(int baudRate = 1'000'000)
{
    PolledLine line;
    line.baudRate = baudRate;
    for (std::uint8_t id = 1; id <= 3; ++id) {
        Traits traits;
        traits.id = id;
        traits.returnDelay = 8us;
        traits.returnDelayKnown = true;
        traits.fastReads = true;
        line.plan.traits.push_back(traits);
        line.plan.spans.push_back({id, {id, 132, 4}, 0ms});
    }
    return line;
}

const RateLimit *find(const std::vector<RateLimit> &limits, What what)
{
    const auto at = std::ranges::find(limits, what, &RateLimit::what);
    return at == limits.end() ? nullptr : &*at;
}

} // namespace

/// What holds polling up is named, with what helps.
class TestRateLimit : public QObject
{
    Q_OBJECT

private slots:
    void theBaudRate()
    {
        const std::vector<RateLimit> limits = limitsOf(three(57'600));
        QCOMPARE(limits.front().what, What::Baud);
        QVERIFY(limits.front().share > 0.9 && !limits.front().hasRemedy);
        QVERIFY(!find(limits, What::ReturnDelay)); // it is 0
        QVERIFY(!find(limits, What::PlainReads));
        double sum = 0;
        for (const RateLimit &limit : limits)
            sum += limit.share;
        QVERIFY(sum > 0.98 && sum < 1.001);
    }

    void theReturnDelay()
    {
        PolledLine line = three(4'000'000);
        line.plan.traits[0].returnDelay = 508us;
        line.plan.traits[2].returnDelay = 508us;
        const std::vector<RateLimit> limits = limitsOf(line);
        QCOMPARE(limits.front().what, What::ReturnDelay);
        QCOMPARE(limits.front().devices, (std::vector<std::uint8_t>{1, 3}));
        QVERIFY(limits.front().hasRemedy);
        const double better = predictPoll(three(4'000'000).plan, 4'000'000, {}).cycleRate;
        QVERIFY(std::abs(limits.front().rateWithout - better) < 1);
    }

    void theLatencyTimer()
    {
        PolledLine line = three();
        line.delays.latencyTimer = 16ms;
        const std::vector<RateLimit> limits = limitsOf(line);
        QCOMPARE(limits.front().what, What::LatencyTimer);
        QVERIFY(limits.front().hasRemedy && limits.front().share > 0.9);
        QVERIFY(limits.front().rateWithout > 5 * predictPoll(line.plan, line.baudRate, line.delays).cycleRate);
        line.delays.latencyTimer = 1ms; // as low as it goes
        QVERIFY(!find(limitsOf(line), What::LatencyTimer)->hasRemedy);
    }

    void fastReadsThatAreOff()
    {
        PolledLine line = three(4'000'000);
        for (Traits &traits : line.plan.traits)
            traits.fastReads = false;
        QVERIFY(!find(limitsOf(line), What::PlainReads)); // they don't know them
        line.couldBeFast = {1, 2, 3};
        const std::vector<RateLimit> limits = limitsOf(line);
        const RateLimit *off = find(limits, What::PlainReads);
        QVERIFY(off && off->hasRemedy);
        QVERIFY(std::abs(off->rateWithout - predictPoll(three(4'000'000).plan, 4'000'000, {}).cycleRate) < 1);
    }

    void aSilentServo()
    {
        PolledLine line = three();
        line.silent = {2};
        line.delays.probe = 60ms; // of every three seconds
        const std::vector<RateLimit> limits = limitsOf(line);
        const RateLimit *silence = find(limits, What::SilentDevice);
        QVERIFY(silence && !silence->hasRemedy);
        QCOMPARE(silence->devices, std::vector<std::uint8_t>{2});
        QVERIFY(std::abs(silence->share - 0.02) < 0.001);
    }

    void nothing()
    {
        PolledLine line = three();
        for (PollSpan &span : line.plan.spans)
            span.interval = 100ms;
        QCOMPARE(limitsOf(line), std::vector<RateLimit>{RateLimit{}});
        line.plan.spans.clear();
        QCOMPARE(limitsOf(line), std::vector<RateLimit>{RateLimit{}});
        line = three(9600); // it can't keep up
        for (PollSpan &span : line.plan.spans)
            span.interval = 10ms;
        QCOMPARE(limitsOf(line).front().what, What::Baud);
    }

    void whatIsNearlyTheSame()
    {
        PolledLine one = three(), two = three();
        one.delays.perExchange = 100us;
        two.delays.perExchange = 103us;
        QVERIFY(one.isLike(two));
        two.delays.perExchange = 130us;
        QVERIFY(!one.isLike(two));
        two = one;
        two.silent = {1};
        QVERIFY(!one.isLike(two));
    }
};

DYNASCOPE_CORE_TEST(TestRateLimit)
#include "tst_ratelimit.moc"
