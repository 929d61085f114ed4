// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/pollturns.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

using Indices = std::vector<std::size_t>;

constexpr int PartOfCycle = 4;

std::vector<PlannedExchange> planSpans(const PollPlan &plan, const Indices &spans, std::span<const Traits> traits,
                                       const ReadCosts &costs)
{
    std::vector<PollSpan> chosen;
    for (const std::size_t span : spans)
        chosen.push_back(plan.spans[span]);
    std::vector<PlannedExchange> exchanges = planExchanges(chosen, traits, costs);
    for (PlannedExchange &exchange : exchanges) {
        for (std::size_t &index : exchange.indices)
            index = spans[index];
    }
    return exchanges;
}

/// An exchange that takes longer than `longest` in several, by its devices.
void addTurns(std::vector<PollTurn> &turns, std::chrono::milliseconds interval, const PlannedExchange &exchange,
              LineTime cost, LineTime longest)
{
    const std::size_t devices = exchange.request.replies.size();
    const auto wanted =
        static_cast<std::size_t>(longest.count() > 0 ? (cost.count() + longest.count() - 1) / longest.count() : 1);
    const std::size_t parts = std::clamp<std::size_t>(wanted, 1, devices);
    std::vector<PollTurn> split(parts, PollTurn{interval, {}});
    for (std::size_t i = 0; i < exchange.indices.size(); ++i)
        split[exchange.replies[i] * parts / devices].spans.push_back(exchange.indices[i]);
    for (PollTurn &turn : split) {
        std::ranges::sort(turn.spans);
        turns.push_back(std::move(turn));
    }
}

} // namespace

ExchangeCost costOf(std::span<const PlannedExchange> exchanges, std::span<const Traits> traits, const ReadCosts &costs)
{
    ExchangeCost sum;
    for (const PlannedExchange &exchange : exchanges)
        sum += costOf(exchange.request, traits, costs.byteTime, costs.delays);
    return sum;
}

std::vector<PollTurn> turnsOf(const PollPlan &plan, const ReadCosts &costs)
{
    std::map<std::chrono::milliseconds, Indices> byInterval;
    for (std::size_t i = 0; i < plan.spans.size(); ++i)
        byInterval[plan.spans[i].interval].push_back(i);
    const bool hasFullRate = byInterval.contains(std::chrono::milliseconds(0));
    LineTime longest{};
    std::vector<PollTurn> turns;
    for (const auto &[interval, spans] : byInterval) {
        if (!hasFullRate || interval.count() == 0) {
            turns.push_back({interval, spans});
            if (hasFullRate)
                longest = costOf(planSpans(plan, spans, plan.traits, costs), plan.traits, costs).total() / PartOfCycle;
            continue;
        }
        for (const PlannedExchange &exchange : planSpans(plan, spans, plan.traits, costs)) {
            const LineTime cost = costOf(exchange.request, plan.traits, costs.byteTime, costs.delays).total();
            addTurns(turns, interval, exchange, cost, longest);
        }
    }
    return turns;
}

std::vector<PlannedExchange> planCycle(const PollPlan &plan, std::span<const std::size_t> spans,
                                       std::span<const Traits> traits, const ReadCosts &costs)
{
    Indices always, rest;
    for (const std::size_t span : spans)
        (plan.spans[span].interval.count() == 0 ? always : rest).push_back(span);
    std::vector<PlannedExchange> joint = planSpans(plan, {spans.begin(), spans.end()}, traits, costs);
    if (always.empty() || rest.empty())
        return joint;
    std::vector<PlannedExchange> apart = planSpans(plan, always, traits, costs);
    for (PlannedExchange &exchange : planSpans(plan, rest, traits, costs))
        apart.push_back(std::move(exchange));
    const bool together = costOf(joint, traits, costs).total() <= costOf(apart, traits, costs).total();
    return together ? joint : apart;
}

} // namespace dynascope
