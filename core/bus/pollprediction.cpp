// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/pollprediction.h"

#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {
namespace {

using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t PingSize = InstructionOverhead;

ExchangeCost difference(const ExchangeCost &all, const ExchangeCost &some)
{
    return {all.request - some.request,   all.replies - some.replies, all.returnDelay - some.returnDelay,
            all.thinking - some.thinking, all.latency - some.latency, all.bytes - std::min(all.bytes, some.bytes)};
}

void add(PollShares &shares, const ExchangeCost &cost, double timesASecond)
{
    const auto part = [timesASecond](LineTime time) { return Seconds(time).count() * timesASecond; };
    shares.requests += part(cost.request);
    shares.replies += part(cost.replies);
    shares.returnDelay += part(cost.returnDelay);
    shares.thinking += part(cost.thinking);
    shares.latency += part(cost.latency);
}

PollPlan withoutSilent(const PollPlan &plan, std::span<const std::uint8_t> silent)
{
    PollPlan rest = plan;
    std::erase_if(rest.spans, [silent](const PollSpan &span) {
        return std::ranges::find(silent, span.span.id) != silent.end();
    });
    return rest;
}

/// A Ping that nobody answers, now and then; reference "Who answers, and when".
double silenceOf(std::uint8_t id, const PollPlan &plan, const ReadCosts &costs)
{
    LineTime probe = costs.delays.probe;
    if (probe <= LineTime()) {
        probe = timing::times(PingSize + 2, costs.byteTime) + returnDelayOf(id, plan.traits)
            + timing::processing(Instruction::Ping) + costs.delays.latencyTimer + 1500us;
    }
    return Seconds(probe) / Seconds(LongestProbeInterval);
}

struct Turn {
    ExchangeCost cost; ///< more than the cycle takes without it
    double often = 0;  ///< wanted, a second

    double seconds() const { return Seconds(cost.total()).count(); }
};

double mostOften(const std::vector<Turn> &turns)
{
    double most = 0;
    for (const Turn &turn : turns)
        most = std::max(most, turn.often);
    return most;
}

/// Part of the time that turns take where none comes oftener than this a second.
double taken(const std::vector<Turn> &turns, double atMost)
{
    double sum = 0;
    for (const Turn &turn : turns)
        sum += turn.seconds() * std::min(turn.often, atMost);
    return sum;
}

/// The largest number up to `most` that `fits`, which all below it do.
template <class Fits>
double largest(double most, const Fits &fits)
{
    if (fits(most))
        return most;
    double low = 0, high = most;
    for (int step = 0; step < 50; ++step) {
        const double middle = (low + high) / 2;
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

/// So often the most frequent turns can come where the line has nothing else to do.
double affordable(const std::vector<Turn> &turns, double most, double left)
{
    return largest(most, [&](double often) { return taken(turns, often) <= left; });
}

/// And where each has to wait for a cycle that no other one takes: who waits longest is next, so those that are wanted
/// rarely come as often as they are wanted, and the others all alike.
double oneACycle(const std::vector<Turn> &turns, double most, double left, double cycle)
{
    return largest(most, [&](double often) {
        double count = 0;
        for (const Turn &turn : turns)
            count += std::min(turn.often, often);
        return count * cycle <= left - taken(turns, often);
    });
}

} // namespace

PollPrediction predictPoll(const PollPlan &plan, int baudRate, const LineDelays &delays,
                           std::span<const std::uint8_t> silent)
{
    ReadCosts costs;
    costs.byteTime = LineTime(10'000'000'000LL / std::max(1, baudRate)); // start bit, eight, stop bit
    costs.delays = delays;
    costs.mayJoin = true;
    const PollPlan asked = withoutSilent(plan, silent);
    const auto costOfCycle = [&](const std::vector<std::size_t> &spans) {
        return costOf(planCycle(asked, spans, asked.traits, costs), asked.traits, costs);
    };
    PollPrediction result;
    result.isKnown = std::ranges::all_of(plan.traits, &Traits::returnDelayKnown);
    std::vector<std::size_t> always;
    ExchangeCost cycle;
    std::vector<Turn> turns;
    double dearest = 0;
    for (const PollTurn &turn : turnsOf(asked, costs)) {
        if (turn.interval.count() == 0) {
            always = turn.spans;
            cycle = costOfCycle(always);
            continue;
        }
        std::vector<std::size_t> spans = always;
        spans.insert(spans.end(), turn.spans.begin(), turn.spans.end());
        std::ranges::sort(spans);
        turns.push_back({difference(costOfCycle(spans), cycle), 1 / Seconds(turn.interval).count()});
        dearest = std::max(dearest, turns.back().seconds());
    }
    for (const std::uint8_t id : silent)
        result.shares.silence += silenceOf(id, plan, costs);
    result.shortest = cycle.total() + (always.empty() ? LineTime() : delays.perCycle);
    result.longest = result.shortest + std::chrono::duration_cast<LineTime>(Seconds(dearest));
    const double most = mostOften(turns);
    const double left = std::max(0.0, 1 - result.shares.silence);
    const double whole = Seconds(result.shortest).count();
    const double often = always.empty() ? affordable(turns, most, left) : oneACycle(turns, most, left, whole);
    result.met = most > 0 ? often / most : 1;
    result.cycleRate = always.empty() ? 0 : (left - taken(turns, often)) / whole;
    add(result.shares, cycle, result.cycleRate);
    result.shares.latency += Seconds(delays.perCycle).count() * result.cycleRate;
    for (const Turn &turn : turns)
        add(result.shares, turn.cost, std::min(turn.often, often));
    result.busLoad = std::min(1.0, result.shares.bytes());
    return result;
}

} // namespace dynascope
