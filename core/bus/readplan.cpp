// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readplan.h"

#include <algorithm>
#include <functional>

namespace dynascope {
namespace {

using Indices = std::vector<std::size_t>;

Traits traitsOf(std::uint8_t id, std::span<const Traits> traits)
{
    const auto known = std::ranges::find(traits, id, &Traits::id);
    if (known != traits.end())
        return *known;
    Traits fresh;
    fresh.id = id;
    return fresh;
}

/// Parameters that fit a device's buffer however they are stuffed.
std::size_t parameterLimit(int receiveBuffer)
{
    const int room = std::min(receiveBuffer, MaximumPacketSize) - InstructionOverhead;
    return static_cast<std::size_t>(std::max(16, room * 3 / 4 - 1));
}

class ReadPlanner
{
public:
    ReadPlanner(std::span<const Span> spans, std::span<const Traits> traits) : m_spans(spans), m_traits(traits) { }

    std::vector<PlannedExchange> plan()
    {
        Indices open;
        for (std::size_t i = 0; i < m_spans.size(); ++i)
            open.push_back(i);
        open = takeLone(open);
        open = takeSync(open);
        takeBulk(open);
        return std::move(m_result);
    }

private:
    Traits traits(std::size_t index) const { return traitsOf(m_spans[index].id, m_traits); }

    /// A device that answers nothing but Ping, or no group read, would break every chain: it stays alone.
    Indices takeLone(const Indices &open)
    {
        Indices rest;
        for (const std::size_t i : open) {
            if (traits(i).statusReturnLevel < 1 || !traits(i).groupReads)
                addSingle(i);
            else
                rest.push_back(i);
        }
        return rest;
    }

    Indices takeSync(Indices open)
    {
        Indices rest;
        while (!open.empty()) {
            const Span first = m_spans[open.front()];
            Indices group, others;
            for (const std::size_t i : open) {
                const Span &span = m_spans[i];
                const bool fits =
                    span.address == first.address && span.length == first.length && !holds(group, span.id);
                (fits ? group : others).push_back(i);
            }
            open = others;
            const Indices left = split(group, true);
            rest.insert(rest.end(), left.begin(), left.end());
        }
        std::ranges::sort(rest);
        return rest;
    }

    void takeBulk(Indices open)
    {
        while (!open.empty()) {
            Indices round, later;
            for (const std::size_t i : open)
                (holds(round, m_spans[i].id) ? later : round).push_back(i);
            for (const std::size_t i : split(round, false))
                addSingle(i);
            open = later;
        }
    }

    /// Fast for those who can, if there are two of them. Returns who is left alone.
    Indices split(const Indices &group, bool sync)
    {
        Indices fast, plain;
        for (const std::size_t i : group)
            (traits(i).fastReads ? fast : plain).push_back(i);
        if (fast.size() == 1) {
            plain = group;
            fast.clear();
        }
        add(fast, sync, true);
        if (plain.size() < 2)
            return plain;
        add(plain, sync, false);
        return {};
    }

    bool holds(const Indices &group, std::uint8_t id) const
    {
        return std::ranges::any_of(group, [&](std::size_t i) { return m_spans[i].id == id; });
    }

    /// As many packets as the buffers of the devices ask for, and for a fast reply that of the controller.
    void add(const Indices &group, bool sync, bool fast)
    {
        std::size_t begin = 0;
        while (begin < group.size()) {
            std::size_t end = begin;
            std::size_t parameters = sync ? 4 : 0;
            std::size_t reply = HeaderSize + 1;
            std::size_t limit = parameterLimit(MaximumPacketSize);
            while (end < group.size()) {
                limit = std::min(limit, parameterLimit(traits(group[end]).receiveBuffer));
                parameters += sync ? 1 : 5;
                reply += m_spans[group[end]].length + std::size_t(FastBlockOverhead);
                if (end > begin && (parameters > limit || (fast && reply > MaximumPacketSize)))
                    break;
                ++end;
            }
            addExchange(Indices(group.begin() + static_cast<std::ptrdiff_t>(begin),
                            group.begin() + static_cast<std::ptrdiff_t>(end)),
                sync, fast);
            begin = end;
        }
    }

    void addExchange(Indices indices, bool sync, bool fast)
    {
        std::vector<Span> spans;
        std::vector<std::uint8_t> ids;
        for (const std::size_t i : indices) {
            spans.push_back(m_spans[i]);
            ids.push_back(m_spans[i].id);
        }
        Request request = sync ? syncReadRequest(spans.front().address, spans.front().length, ids, fast)
                               : bulkReadRequest(spans, fast);
        m_result.push_back({std::move(request), std::move(indices)});
    }

    void addSingle(std::size_t index) { m_result.push_back({readRequest(m_spans[index]), {index}}); }

    std::span<const Span> m_spans;
    std::span<const Traits> m_traits;
    std::vector<PlannedExchange> m_result;
};

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
    return ReadPlanner(spans, traits).plan();
}

std::vector<PlannedExchange> planExchanges(std::span<const PollSpan> spans, std::span<const Traits> traits)
{
    std::vector<Span> plain;
    for (const PollSpan &span : spans)
        plain.push_back(span.span);
    return planReads(plain, traits);
}

std::vector<Request> planWrites(std::span<const SpanData> writes, std::span<const Traits> traits)
{
    std::size_t limit = parameterLimit(MaximumPacketSize);
    for (const SpanData &write : writes)
        limit = std::min(limit, parameterLimit(traitsOf(write.id, traits).receiveBuffer));
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
