// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/readcost.h"

#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t ReadSize = InstructionOverhead + 4;
constexpr std::size_t FastPrefix = HeaderSize + 1; ///< with the instruction: before the first device's block

/// The adapter between wire and program: what it still holds when the last byte has come, and how long.
class Adapter
{
public:
    Adapter(const LineDelays &delays, LineTime byteTime) : m_delays(delays), m_byteTime(byteTime) { }

    /// Bytes without a gap, the first of which has come whole at `at`.
    void take(LineTime at, std::size_t count)
    {
        const auto full = static_cast<std::size_t>(std::max(1, m_delays.latencyBuffer));
        for (std::size_t i = 0; i < count; ++i, at += m_byteTime) {
            if (m_held > 0 && at > m_since + m_delays.latencyTimer)
                m_held = 0;
            if (m_held++ == 0)
                m_since = at;
            if (m_held >= full)
                m_held = 0;
            m_last = at;
        }
    }
    LineTime rest() const
    {
        return m_held > 0 ? std::max(LineTime(), m_since + m_delays.latencyTimer - m_last) : LineTime();
    }

private:
    const LineDelays &m_delays;
    LineTime m_byteTime;
    std::size_t m_held = 0;
    LineTime m_since{}, m_last{};
};

std::size_t requestSize(ReadKind kind, std::size_t devices)
{
    switch (kind) {
    case ReadKind::Single: return ReadSize;
    case ReadKind::Sync:
    case ReadKind::FastSync: return ReadSize + devices;
    case ReadKind::Bulk:
    case ReadKind::FastBulk: break;
    }
    return InstructionOverhead + 5 * devices;
}

ReadKind kindOf(const Request &request)
{
    switch (request.packet.instruction) {
    case Instruction::SyncRead: return ReadKind::Sync;
    case Instruction::FastSyncRead: return ReadKind::FastSync;
    case Instruction::BulkRead: return ReadKind::Bulk;
    case Instruction::FastBulkRead: return ReadKind::FastBulk;
    default: return ReadKind::Single;
    }
}

} // namespace

ExchangeCost &ExchangeCost::operator+=(const ExchangeCost &other)
{
    request += other.request;
    replies += other.replies;
    returnDelay += other.returnDelay;
    thinking += other.thinking;
    latency += other.latency;
    bytes += other.bytes;
    return *this;
}

LineTime returnDelayOf(std::uint8_t id, std::span<const Traits> traits)
{
    const auto at = std::ranges::find(traits, id, &Traits::id);
    return at == traits.end() ? Traits().returnDelay : at->returnDelay;
}

ExchangeCost costOf(ReadKind kind, std::span<const AskedDevice> asked, LineTime byteTime, const LineDelays &delays)
{
    const LineTime thinking = timing::processing(Instruction::Read);
    const std::size_t size = requestSize(kind, asked.size());
    ExchangeCost cost;
    cost.request = timing::times(size, byteTime);
    cost.bytes = size;
    Adapter adapter(delays, byteTime);
    const bool held = delays.latencyTimer > LineTime();
    LineTime at{};
    const auto reply = [&](std::size_t bytes, LineTime delay, LineTime thought) {
        cost.replies += timing::times(bytes, byteTime);
        cost.returnDelay += delay;
        cost.thinking += thought;
        cost.bytes += bytes;
        at += delay + thought + byteTime;
        if (held)
            adapter.take(at, bytes);
        at += timing::times(bytes - 1, byteTime);
    };
    bool isFirst = true;
    for (const AskedDevice &device : asked) {
        if (!isFast(kind))
            reply(std::size_t(StatusOverhead) + device.length, device.returnDelay, thinking);
        else if (isFirst) // it waits for all of them
            reply(FastPrefix + FastBlockOverhead + device.length, device.returnDelay, thinking);
        else
            reply(std::size_t(FastBlockOverhead) + device.length, {}, {});
        isFirst = false;
    }
    cost.latency = delays.perExchange + (held ? adapter.rest() : LineTime());
    return cost;
}

ExchangeCost costOf(const Request &request, std::span<const Traits> traits, LineTime byteTime, const LineDelays &delays)
{
    std::vector<AskedDevice> asked;
    for (const ExpectedReply &reply : request.replies)
        asked.push_back({reply.length, returnDelayOf(reply.id, traits)});
    return costOf(kindOf(request), asked, byteTime, delays);
}

} // namespace dynascope
