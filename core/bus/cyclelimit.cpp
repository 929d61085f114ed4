// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/cyclelimit.h"

#include "core/bus/line.h"
#include "core/bus/readplan.h"
#include "core/bus/timing.h"

#include <algorithm>
#include <map>

namespace dynascope {

namespace {

using Seconds = std::chrono::duration<double>;

LineTime returnDelayOf(std::uint8_t id, std::span<const Traits> traits)
{
    const auto at = std::ranges::find(traits, id, &Traits::id);
    return at == traits.end() ? Traits().returnDelay : at->returnDelay;
}

/// How long the wire is taken by one exchange whose every answer comes.
LineTime wireTime(const Request &request, std::span<const Traits> traits, LineTime byteTime)
{
    const LineTime thinking = timing::processing(request.packet.instruction);
    LineTime time = timing::times(encode(request.packet).size(), byteTime);
    if (request.replies.empty())
        return time;
    if (request.shape == ReplyShape::Fast) // the others add to the first one's packet
        return time + timing::times(request.maximumReplySize(), byteTime) + thinking
            + returnDelayOf(request.replies.front().id, traits);
    for (const ExpectedReply &reply : request.replies)
        time += timing::times(StatusOverhead + reply.length, byteTime) + thinking + returnDelayOf(reply.id, traits);
    return time;
}

LineTime wireTime(std::span<const PollSpan> spans, std::span<const Traits> traits, LineTime byteTime)
{
    LineTime time{};
    for (const PlannedExchange &exchange : planExchanges(spans, traits))
        time += wireTime(exchange.request, traits, byteTime);
    return time;
}

} // namespace

double possibleCycleRate(const PollPlan &plan, int baudRate)
{
    if (!std::ranges::all_of(plan.traits, &Traits::returnDelayKnown))
        return 0;
    std::map<std::chrono::milliseconds, std::vector<PollSpan>> byInterval;
    for (const PollSpan &span : plan.spans)
        byInterval[span.interval].push_back(span);
    const LineTime byteTime(10'000'000'000LL / std::max(1, baudRate)); // start bit, eight, stop bit
    LineTime cycle{};
    double others = 0; // part of each second
    for (const auto &[interval, spans] : byInterval) {
        const LineTime time = wireTime(spans, plan.traits, byteTime);
        if (interval.count() == 0)
            cycle = time;
        else
            others += Seconds(time) / Seconds(interval);
    }
    return cycle.count() > 0 && others < 1 ? (1 - others) / Seconds(cycle).count() : 0;
}

} // namespace dynascope
