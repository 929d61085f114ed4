// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/lateanswers.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t PingLength = 3;

} // namespace

void LateAnswers::add(const Entry &entry)
{
    const auto same = std::ranges::find_if(m_entries, [&](const Entry &other) {
        return other.id == entry.id && other.length == entry.length && other.kind == entry.kind;
    });
    if (same == m_entries.end())
        m_entries.push_back(entry);
    else
        same->origin = entry.origin;
}

LateAnswers::Entry::Kind LateAnswers::kindOf(const Request &request)
{
    return request.packet.instruction == Instruction::Ping ? Entry::Kind::Ping : Entry::Kind::Plain;
}

void LateAnswers::forgetOld(LineTime now)
{
    std::erase_if(m_entries, [now](const Entry &entry) { return now - entry.origin > Longest; });
}

void LateAnswers::addMissing(const Request &request, const ExchangeResult &result, LineTime origin)
{
    const auto isMissing = [](const Result<Reply> &reply) {
        return !reply && reply.error().kind != ErrorKind::Refused;
    };
    if (request.shape == ReplyShape::Fast) {
        if (std::ranges::any_of(result.replies, isMissing))
            add({BroadcastId, request.maximumReplySize(), Entry::Kind::Fast, origin});
        return;
    }
    // Those before the last one heard won't come any more: the answers of one request keep their order, too.
    std::size_t open = result.replies.size();
    while (open > 0 && isMissing(result.replies[open - 1]))
        --open;
    for (std::size_t i = open; i < request.replies.size() && i < result.replies.size(); ++i)
        add({request.replies[i].id, request.replies[i].length, kindOf(request), origin});
}

void LateAnswers::addPings(LineTime origin)
{
    add({BroadcastId, PingLength, Entry::Kind::Ping, origin});
}

void LateAnswers::addAll(const Request &request, LineTime origin)
{
    if (request.shape == ReplyShape::Anyone)
        addPings(origin);
    else if (request.shape == ReplyShape::Fast)
        add({BroadcastId, request.maximumReplySize(), Entry::Kind::Fast, origin});
    else
        for (const ExpectedReply &reply : request.replies)
            add({reply.id, reply.length, kindOf(request), origin});
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
    return couldBe(id, PingLength, false);
}

bool LateAnswers::couldFakePing(std::uint8_t id) const
{
    return std::ranges::any_of(m_entries, [id](const Entry &entry) {
        return entry.kind == Entry::Kind::Plain && entry.id == id && entry.length == PingLength;
    });
}

bool LateAnswers::couldBeFast(std::size_t packetSize) const
{
    return std::ranges::any_of(
        m_entries, [packetSize](const Entry &entry) { return entry.kind == Entry::Kind::Fast && entry.length == packetSize; });
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
    std::uint16_t length = 2; // the model number; every table has some tens of bytes behind it
    while (length == PingLength || couldBe(id, length, false))
        ++length;
    return length;
}

std::optional<LineTime> LateAnswers::originOf(std::uint8_t id, std::size_t length) const
{
    const auto entry = std::ranges::find_if(
        m_entries, [&](const Entry &other) { return other.kind != Entry::Kind::Fast && other.id == id && other.length == length; });
    if (entry == m_entries.end())
        return std::nullopt;
    return entry->origin;
}

} // namespace dynascope
