// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/lateanswers.h"

#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {

namespace {

/// Missing, or taken as done because the device is thought to be mute: it may speak all the same.
bool isOpen(const Result<Reply> &reply)
{
    return isMissing(reply) || (reply && reply->bytes == 0);
}

} // namespace

void LateAnswers::add(const Entry &entry)
{
    const auto same = std::ranges::find_if(m_entries, [&](const Entry &other) {
        return other.id == entry.id && other.length == entry.length && other.kind == entry.kind;
    });
    if (same == m_entries.end())
        m_entries.push_back(entry);
    else
        *same = entry;
}

LateAnswers::Entry LateAnswers::entryFor(const Request &request, const ExpectedReply &reply, LineTime origin)
{
    const bool isPing = request.packet.instruction == Instruction::Ping;
    const LineTime held = request.isWrite() ? timing::processing(request.packet.instruction) : LineTime();
    return {reply.id, reply.length, isPing ? Entry::Kind::Ping : Entry::Kind::Plain, origin, origin + held};
}

void LateAnswers::clear(std::uint8_t id, LineTime now)
{
    std::erase_if(m_entries, [&](const Entry &entry) { return entry.id == id || entry.heldUntil <= now; });
}

void LateAnswers::rateChanged()
{
    std::erase_if(m_entries, [](const Entry &entry) {
        return entry.id == BroadcastId && entry.kind == Entry::Kind::Ping; // was waited for to the end
    });
    for (Entry &entry : m_entries) {
        if (entry.kind == Entry::Kind::Ping)
            entry.kind = Entry::Kind::Plain;
    }
}

void LateAnswers::forgetOld(LineTime now)
{
    std::erase_if(m_entries, [now](const Entry &entry) { return now - entry.origin > Longest; });
}

void LateAnswers::addMissing(const Request &request, const ExchangeResult &result, LineTime origin)
{
    if (request.shape == ReplyShape::Fast) {
        if (std::ranges::any_of(result.replies, isMissing))
            add({BroadcastId, request.maximumReplySize(), Entry::Kind::Fast, origin, origin});
        return;
    }
    // Those before the last one heard won't come any more: the answers of one request keep their order, too.
    std::size_t open = result.replies.size();
    while (open > 0 && isOpen(result.replies[open - 1]))
        --open;
    for (std::size_t i = open; i < request.replies.size() && i < result.replies.size(); ++i)
        add(entryFor(request, request.replies[i], origin));
}

void LateAnswers::addPings(LineTime origin)
{
    add({BroadcastId, PingReplyLength, Entry::Kind::Ping, origin, origin});
}

void LateAnswers::addAll(const Request &request, LineTime origin)
{
    if (request.shape == ReplyShape::Anyone)
        addPings(origin);
    else if (request.shape == ReplyShape::Fast)
        add({BroadcastId, request.maximumReplySize(), Entry::Kind::Fast, origin, origin});
    else
        for (const ExpectedReply &reply : request.replies)
            add(entryFor(request, reply, origin));
}

bool LateAnswers::couldBe(std::uint8_t id, std::size_t length, bool isError) const
{
    return std::ranges::any_of(m_entries, [&](const Entry &entry) {
        if (entry.kind == Entry::Kind::Fast || (entry.id != id && entry.id != BroadcastId))
            return false;
        return isError ? entry.kind != Entry::Kind::Ping : entry.length == length;
    });
}

bool LateAnswers::couldBePing(std::uint8_t id) const
{
    return couldBe(id, PingReplyLength, false);
}

bool LateAnswers::couldFakePing(std::uint8_t id) const
{
    return std::ranges::any_of(m_entries, [id](const Entry &entry) {
        return entry.kind == Entry::Kind::Plain && entry.id == id && entry.length == PingReplyLength;
    });
}

bool LateAnswers::couldBeFast(std::size_t packetSize) const
{
    return std::ranges::any_of(
        m_entries, [packetSize](const Entry &entry) {
            return entry.kind == Entry::Kind::Fast && entry.length == packetSize;
        });
}

bool LateAnswers::concern(const Request &request) const
{
    if (request.replies.empty() || m_entries.empty())
        return false;
    if (request.shape == ReplyShape::Fast)
        return couldBeFast(request.maximumReplySize());
    const ExpectedReply &first = request.replies.front();
    if (request.packet.instruction == Instruction::Ping)
        return couldFakePing(first.id);
    return couldBe(first.id, first.length, false) || couldBe(first.id, first.length, true);
}

std::uint16_t LateAnswers::distinctLength(std::uint8_t id) const
{
    constexpr std::uint16_t Largest = 140; // nearly every table is longer; where it isn't, the refusal is no answer
    for (std::uint16_t length = 2; length <= Largest; ++length) {
        if (length != PingReplyLength && !couldBe(id, length, false))
            return length;
    }
    return 0;
}

std::optional<LineTime> LateAnswers::originOf(std::uint8_t id, std::size_t length) const
{
    const auto entry = std::ranges::find_if(m_entries, [&](const Entry &other) {
        return other.kind != Entry::Kind::Fast && other.id == id && other.length == length;
    });
    if (entry == m_entries.end())
        return std::nullopt;
    return entry->origin;
}

} // namespace dynascope
