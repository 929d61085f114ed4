// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/remainder.h"

#include <algorithm>

namespace dynascope {
namespace {

Request groupRead(const Request &original, const std::vector<Span> &spans)
{
    const Instruction instruction = original.packet.instruction;
    const bool fast = original.shape == ReplyShape::Fast;
    if (instruction == Instruction::BulkRead || instruction == Instruction::FastBulkRead)
        return bulkReadRequest(spans, fast);
    std::vector<std::uint8_t> ids;
    for (const Span &span : spans)
        ids.push_back(span.id);
    return syncReadRequest(spans.front().address, spans.front().length, ids, fast);
}

} // namespace

Remainder remainderOf(const Request &request, const ExchangeResult &result)
{
    Remainder rest;
    for (std::size_t i = 0; i < result.replies.size(); ++i) {
        if (isMissing(result.replies[i]))
            rest.indices.push_back(i);
    }
    if (rest.indices.empty())
        return rest;
    if (request.shape != ReplyShape::InOrder && request.shape != ReplyShape::Fast) {
        rest.request = request;
        return rest;
    }
    const auto broken = std::ranges::find(rest.indices, static_cast<std::size_t>(std::max(0, result.brokenAt)));
    if (result.brokenAt >= 0 && broken != rest.indices.end())
        std::rotate(broken, broken + 1, rest.indices.end());
    const auto command = decodeCommand(request.packet);
    const auto *read = command ? std::get_if<GroupReadCommand>(&*command) : nullptr;
    if (!read || read->spans.size() != request.replies.size()) {
        rest.indices.clear();
        return rest;
    }
    std::vector<Span> spans;
    for (const std::size_t index : rest.indices)
        spans.push_back(read->spans[index]);
    rest.request = groupRead(request, spans);
    return rest;
}

namespace {

/// Does such a failure say less than what was seen before it?
bool isLess(ErrorKind kind)
{
    return kind == ErrorKind::LateAnswer || kind == ErrorKind::NotSent;
}

} // namespace

void merge(ExchangeResult &total, ExchangeResult again, const std::vector<std::size_t> &indices)
{
    total.brokenAt = again.brokenAt < 0 ? -1 : static_cast<int>(indices[static_cast<std::size_t>(again.brokenAt)]);
    for (std::size_t i = 0; i < indices.size() && i < again.replies.size(); ++i) {
        const bool saysLess = !again.replies[i] && isLess(again.replies[i].error().kind);
        if (!saysLess) // than what was seen at first
            total.replies[indices[i]] = std::move(again.replies[i]);
    }
    total.seen.bytesReceived += again.seen.bytesReceived;
    total.seen.noiseBytes += again.seen.noiseBytes;
    total.seen.damagedPackets += again.seen.damagedPackets;
    total.seen.damagedIds.insert(total.seen.damagedIds.end(), again.seen.damagedIds.begin(), again.seen.damagedIds.end());
    total.seen.strayPackets += again.seen.strayPackets;
    total.seen.lateAnswers += again.seen.lateAnswers;
    total.seen.strayIds.insert(total.seen.strayIds.end(), again.seen.strayIds.begin(), again.seen.strayIds.end());
    total.seen.echo = total.seen.echo || again.seen.echo;
    total.seen.retries += again.seen.retries;
    total.seen.roundTrip = again.seen.roundTrip;
}

} // namespace dynascope
