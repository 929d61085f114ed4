// SPDX-License-Identifier: GPL-3.0-or-later
// Of Bus: how long an exchange waits, and what silence means.
#include "core/bus/buswaiting.h"

#include "core/bus/messages.h"
#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

/// However it babbles: no exchange takes longer.
LineTime Bus::longestWait(const Request &request, const Waiting &waiting) const
{
    const Line &line = m_channel.line();
    const LineTime longest = timing::times(request.maximumReplySize(), line.byteTime());
    const LineTime each = timing::silence(line) + timing::processing(request.packet.instruction) + 1ms;
    LineTime hosts = request.replies.empty() ? line.hostAllowance() : LineTime();
    for (const ExpectedReply &reply : request.replies)
        hosts += m_timing.allowance(reply.id, line.hostAllowance());
    const LineTime turns =
        request.shape == ReplyShape::Anyone ? (waiting.highestId + 1) * timing::SlotOfBroadcastPing : LineTime();
    return waiting.origin + 2 * longest + turns + hosts + timing::times(std::max<std::size_t>(1, request.replies.size()), each);
}

/// How much later than its registers say the next answer is waited for.
LineTime Bus::allowance(const Request &request) const
{
    const LineTime host = m_channel.line().hostAllowance();
    if (request.replies.empty())
        return host;
    return m_timing.allowance(request.replies[m_collector.position()].id, host);
}

/// Reference "Time": return delay, processing and host from the end of the request, or of the predecessor's packet.
LineTime Bus::deadline(const Request &request, const Waiting &waiting) const
{
    const LineTime processing = timing::processing(request.packet.instruction);
    if (request.shape == ReplyShape::None)
        return waiting.origin + allowance(request) + processing;
    if (request.shape == ReplyShape::Anyone) {
        // Behind the answer of one ID come the slots of those above it. The last of them may hold an answer.
        const LineTime answer = Traits().returnDelay + timing::times(timing::largestStatus(PingReplyLength), m_channel.line().byteTime());
        const auto heard = static_cast<LineTime::rep>(m_collector.answers());
        const LineTime all = waiting.sent + (waiting.highestId + 1 - heard) * timing::SlotOfBroadcastPing;
        const LineTime rest =
            waiting.origin + (waiting.highestId - m_collector.lastId()) * timing::SlotOfBroadcastPing;
        const LineTime longest = all + heard * (timing::SlotOfBroadcastPing + answer);
        return std::clamp(rest, all, longest) + allowance(request) + processing + answer;
    }
    const std::uint8_t next = request.replies[m_collector.position()].id;
    const LineTime firstByte = 2 * m_channel.line().byteTime();
    // Nothing is expected of a device that is told to be silent: no need to wait until it has written its EEPROM.
    return waiting.origin + allowance(request) + traits(next).returnDelay + firstByte
        + (isMute(request, next) ? timing::processing(Instruction::Read) : processing);
}

/// When the answers have left the wire, as far as that is known: of those to a broadcast Ping, that of ID 0.
LineTime Bus::answerEnd(const Request &request, LineTime sent) const
{
    const LineTime byteTime = m_channel.line().byteTime();
    if (request.shape == ReplyShape::Anyone)
        return sent + Traits().returnDelay + timing::times(timing::largestStatus(PingReplyLength), byteTime);
    if (request.shape == ReplyShape::Single && isMute(request, request.replies.front().id))
        return sent;
    LineTime end = sent + timing::times(request.maximumReplySize(), byteTime);
    for (const ExpectedReply &reply : request.replies) {
        end += traits(reply.id).returnDelay;
        if (request.shape == ReplyShape::Fast) // the others follow at once
            break;
    }
    return end;
}

/// Which of two Pings was answered nobody knows.
bool Bus::mayBeEarlierPings(const Request &request, const ExchangeResult &result) const
{
    return request.packet.instruction == Instruction::Ping && !result.replies.empty() && result.replies.front()
        && m_late.couldBePing(result.replies.front()->id);
}

/// Will this device keep silent about this request, by its Status Return Level?
bool Bus::isMute(const Request &request, std::uint8_t id) const
{
    return request.isWrite() && traits(id).statusReturnLevel < 2;
}

/// Is it no fault of the line if nothing comes? A Ping asks whether anybody is there; some are told to be silent.
bool Bus::isExpectedSilence(const Request &request) const
{
    if (m_asking > 0 || request.packet.instruction == Instruction::Ping)
        return true;
    return request.replies.size() == 1 && traits(request.replies.front().id).statusReturnLevel < 1;
}

/// At a low Status Return Level silence is what was to be expected.
void Bus::explainSilence(const Request &request, ExchangeResult &result) const
{
    if (request.packet.instruction == Instruction::Ping)
        return;
    for (std::size_t i = 0; i < result.replies.size(); ++i) {
        Result<Reply> &reply = result.replies[i];
        if (reply)
            continue;
        const ErrorKind kind = reply.error().kind;
        if (kind != ErrorKind::NothingReceived && kind != ErrorKind::LateAnswer && kind != ErrorKind::NotSent)
            continue;
        const std::uint8_t id = request.replies[i].id;
        const int level = traits(id).statusReturnLevel;
        if (isMute(request, id))
            reply = Reply{id, DeviceError::None, false, {}, m_channel.now()};
        else if (level < 1)
            reply = tl::unexpected(messages::silentByLevel(id, level));
    }
}

} // namespace dynascope
