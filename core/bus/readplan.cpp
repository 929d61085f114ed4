// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readplan.h"

#include <algorithm>

namespace dynascope {
namespace {

std::vector<PlannedExchange> planned(const std::vector<ChosenRead> &reads)
{
    std::vector<PlannedExchange> result;
    for (const ChosenRead &read : reads) {
        result.push_back({read.request(), read.spans, read.replies, {}});
        for (const Span &span : read.asked)
            result.back().begins.push_back(span.address);
    }
    return result;
}

/// Cuts `group` into packets of at most `limit` parameter bytes.
void addWrites(std::vector<Request> &result, const std::vector<SpanData> &group, bool sync, std::size_t limit)
{
    std::vector<SpanData> part;
    std::size_t size = sync ? 4 : 0;
    const auto flush = [&] {
        if (!part.empty())
            result.push_back(sync ? syncWriteRequest(part) : bulkWriteRequest(part));
        part.clear();
        size = sync ? 4 : 0;
    };
    for (const SpanData &write : group) {
        const std::size_t more = write.data.size() + (sync ? 1U : 5U);
        if (!part.empty() && size + more > limit)
            flush();
        part.push_back(write);
        size += more;
    }
    flush();
}

} // namespace

std::vector<PlannedExchange> planReads(std::span<const Span> spans, std::span<const Traits> traits)
{
    return planned(chooseReads(spans, traits, {}));
}

std::vector<PlannedExchange> planExchanges(std::span<const PollSpan> spans, std::span<const Traits> traits,
                                           const ReadCosts &costs)
{
    std::vector<Span> plain;
    for (const PollSpan &span : spans)
        plain.push_back(span.span);
    return planned(chooseReads(plain, traits, costs));
}

std::vector<Request> planWrites(std::span<const SpanData> writes, std::span<const Traits> traits)
{
    std::size_t limit = parameterLimit(MaximumPacketSize);
    for (const SpanData &write : writes) {
        const auto known = std::ranges::find(traits, write.id, &Traits::id);
        limit = std::min(limit, parameterLimit(known == traits.end() ? Traits().receiveBuffer : known->receiveBuffer));
    }
    std::vector<Request> result;
    std::vector<SpanData> open(writes.begin(), writes.end());
    std::vector<SpanData> alone;
    const auto repeated = [](const std::vector<SpanData> &group, const SpanData &write) {
        return std::ranges::any_of(group, [&](const SpanData &other) { return other.id == write.id; });
    };
    while (!open.empty()) {
        std::vector<SpanData> group, others;
        for (const SpanData &write : open) {
            const bool same = write.address == open.front().address && write.data.size() == open.front().data.size();
            (same && !repeated(group, write) ? group : others).push_back(write);
        }
        if (group.size() > 1 || (others.empty() && alone.empty()))
            addWrites(result, group, true, limit);
        else
            alone.insert(alone.end(), group.begin(), group.end());
        open = others;
    }
    while (!alone.empty()) { // one device may not stand twice in a Bulk list
        std::vector<SpanData> round, later;
        for (const SpanData &write : alone)
            (repeated(round, write) ? later : round).push_back(write);
        addWrites(result, round, false, limit);
        alone = later;
    }
    return result;
}

} // namespace dynascope
