// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/bus.h"

#include "core/bus/collector.h"
#include "core/bus/messages.h"
#include "core/bus/remainder.h"
#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime SettleLimit = 50ms;
/// Adapters hand the last bytes to the wire a little later than computed; a change of rate must not catch them.
constexpr LineTime DrainMargin = 2ms;

} // namespace

/// What one exchange waits by.
struct Bus::Waiting {
    LineTime begin{};  ///< write start
    LineTime origin{}; ///< from when the present deadline counts: t0, or the end of the predecessor's packet
    LineTime limit{};  ///< whatever comes, not longer than this
    LineTime lastByte{};
    int highestId = MaximumId;
    std::function<void(const Reply &)> found;
};

Bus::Bus(Line &line, const std::atomic<bool> *stop) : m_line(line), m_stop(stop) { }

void Bus::setTraits(std::vector<Traits> traits)
{
    m_traits = std::move(traits);
}

Traits Bus::traits(std::uint8_t id) const
{
    const auto known = std::ranges::find(m_traits, id, &Traits::id);
    if (known != m_traits.end())
        return *known;
    Traits fresh;
    fresh.id = id;
    fresh.baudRate = m_line.baudRate();
    return fresh;
}

Result<ExchangeResult> Bus::exchange(const Request &request, int retries)
{
    if (const std::size_t size = encode(request.packet).size(); size > MaximumPacketSize)
        return tl::unexpected(messages::packetTooLong(size, MaximumPacketSize));
    Result<ExchangeResult> first = attempt(request);
    if (!first || !request.isIdempotent())
        return first;
    ExchangeResult total = std::move(*first);
    for (int retry = 0; retry < retries; ++retry) {
        const Remainder rest = remainderOf(request, total);
        if (rest.indices.empty())
            break;
        Result<ExchangeResult> again = attempt(rest.request);
        if (!again)
            return again;
        ++m_statistics.retries;
        ++total.seen.retries;
        merge(total, std::move(*again), rest.indices);
    }
    return total;
}

Result<ExchangeResult> Bus::broadcastPing(int highestId, const std::function<void(const Reply &)> &found)
{
    Waiting waiting;
    waiting.highestId = std::clamp(highestId, 0, static_cast<int>(MaximumId));
    waiting.found = found;
    if (Result<void> ready = prepare(); !ready)
        return tl::unexpected(ready.error());
    return perform(pingRequest(BroadcastId), waiting);
}

Result<ExchangeResult> Bus::attempt(const Request &request)
{
    if (Result<void> ready = prepare(); !ready)
        return tl::unexpected(ready.error());
    const bool couldMistake = request.packet.instruction != Instruction::Ping && !request.replies.empty();
    if (m_doubtful && couldMistake) {
        Error silence;
        const Result<bool> answered = fence(request.replies.front().id, silence);
        if (!answered)
            return tl::unexpected(answered.error());
        if (!*answered) { // whoever doesn't answer a Ping would break the chain, too
            ExchangeResult result;
            result.replies.push_back(tl::unexpected(silence));
            for (std::size_t i = 1; i < request.replies.size(); ++i)
                result.replies.push_back(
                    tl::unexpected(messages::chainBroken(request.replies[i].id, request.replies.front().id)));
            result.brokenAt = 0;
            return result;
        }
        if (Result<void> ready = prepare(); !ready)
            return tl::unexpected(ready.error());
    }
    Waiting waiting;
    return perform(request, waiting);
}

/// Adapters delay, but keep the order: one answered Ping proves that nothing older is in flight.
Result<bool> Bus::fence(std::uint8_t id, Error &silence)
{
    Waiting waiting;
    const Result<ExchangeResult> ping = perform(pingRequest(id), waiting);
    if (!ping)
        return tl::unexpected(ping.error());
    if (!ping->replies.front())
        silence = ping->replies.front().error();
    return ping->replies.front().has_value();
}

Result<ExchangeResult> Bus::perform(const Request &request, Waiting &waiting)
{
    const Bytes packet = encode(request.packet);
    Collector::Heard heard;
    if (m_tap)
        heard = [this](LineTime at, ByteView bytes) { m_tap(Direction::Received, at, bytes); };
    Collector collector(request, packet, std::move(heard), std::move(waiting.found));
    if (m_echoes)
        collector.expectEcho();
    waiting.begin = m_line.now();
    if (Result<void> sent = send(packet); !sent)
        return tl::unexpected(sent.error());
    waiting.origin = m_sentBy;
    const Result<void> listened = listen(collector, request, waiting);
    m_statistics.busy += m_line.now() - waiting.begin;
    if (!listened) {
        m_unsettled = m_doubtful = true;
        return tl::unexpected(listened.error());
    }
    ExchangeResult result;
    result.seen = collector.seen();
    result.seen.roundTrip = collector.lastPacketAt().value_or(m_line.now()) - waiting.begin;
    result.brokenAt = collector.brokenAt();
    result.replies = collector.replies(m_line.now() - waiting.origin);
    explainSilence(request, result);
    m_echoes = m_echoes || result.seen.echo;
    const auto lost = [](const Result<Reply> &reply) { return !reply && reply.error().kind != ErrorKind::Refused; };
    const bool anyLost = std::ranges::any_of(result.replies, lost);
    if (anyLost)
        m_doubtful = true;
    else if (request.packet.instruction == Instruction::Ping && request.shape == ReplyShape::Single)
        m_doubtful = false;
    m_unsettled = anyLost || result.seen.strayPackets > 0 || result.seen.noiseBytes > 0 || collector.isMidPacket();
    count(result);
    return result;
}

/// Nothing that belongs to an earlier request may be taken for the answer to the next one.
Result<void> Bus::prepare()
{
    if (isStopped())
        return tl::unexpected(messages::stopped());
    if (isCancelled())
        return tl::unexpected(messages::cancelled());
    m_received.clear();
    if (Result<void> read = keep(m_line.read(m_received, m_line.now())); !read)
        return read;
    if (!m_received.empty()) {
        m_statistics.bytesReceived += m_received.size();
        if (m_received == m_lastSent) // the echo of a request that nobody answers
            m_echoes = true;
        else
            m_unsettled = true;
    }
    if (!m_unsettled)
        return {};
    if (Result<void> quiet = settleFor(std::max<LineTime>(1500us, 10 * m_line.byteTime()), SettleLimit, true); !quiet)
        return quiet;
    m_unsettled = false;
    return {};
}

/// What is on its way out is let out: a port that is closed under it would cut it.
Result<void> Bus::mayWait() const
{
    if (isStopped())
        return tl::unexpected(messages::stopped());
    if (isCancelled() && m_line.now() >= m_sentBy)
        return tl::unexpected(messages::cancelled());
    return {};
}

Result<void> Bus::send(ByteView packet)
{
    const LineTime begin = std::max(m_line.now(), m_sentBy);
    if (Result<void> written = keep(m_line.write(packet)); !written)
        return written;
    m_sentBy = begin + static_cast<LineTime::rep>(packet.size()) * m_line.byteTime();
    m_lastSent.assign(packet.begin(), packet.end());
    m_statistics.bytesSent += packet.size();
    if (m_tap)
        m_tap(Direction::Sent, begin, packet);
    return {};
}

Result<void> Bus::sendOnly(ByteView packet)
{
    if (Result<void> sent = send(packet); !sent)
        return sent;
    m_unsettled = true;
    return waitUntil(m_sentBy, false);
}

Result<void> Bus::listen(Collector &collector, const Request &request, Waiting &waiting)
{
    const LineTime longest = static_cast<LineTime::rep>(request.maximumReplySize()) * m_line.byteTime();
    const auto devices = static_cast<LineTime::rep>(std::max<std::size_t>(1, request.replies.size()));
    waiting.limit = waiting.origin + 2 * longest
        + devices * (timing::silence(m_line) + timing::processing(request.packet.instruction) + 1ms);
    if (request.shape == ReplyShape::Anyone)
        waiting.limit += (MaximumId + 1) * timing::SlotOfBroadcastPing;
    if (request.shape == ReplyShape::None && !m_echoes)
        return waitUntil(m_sentBy, true);
    while (!collector.isComplete()) {
        if (Result<void> may = mayWait(); !may)
            return may;
        const LineTime now = m_line.now();
        LineTime until = deadline(collector, request, waiting);
        if (collector.isMidPacket()) {
            until = std::min(waiting.lastByte + timing::silence(m_line), waiting.limit);
            if (now >= until) {
                collector.giveUp(now);
                continue;
            }
        } else {
            // Somebody else's packet or noise held the wire when the answer was due.
            if (collector.seen().bytesReceived > 0)
                until = std::max(until, std::min(waiting.limit, waiting.lastByte + 10 * m_line.byteTime()));
            if (now >= until)
                break;
        }
        if (Result<void> read = receive(std::min(until, now + timing::Slice)); !read)
            return read;
        if (m_received.empty())
            continue;
        waiting.lastByte = m_line.now();
        collector.feed(m_received, waiting.lastByte);
        if (const auto packetAt = collector.lastPacketAt(); packetAt && request.shape != ReplyShape::Anyone)
            waiting.origin = std::max(waiting.origin, *packetAt);
    }
    return {};
}

/// Reference "Time": return delay, processing and host from the end of the request, or of the predecessor's packet.
LineTime Bus::deadline(const Collector &collector, const Request &request, const Waiting &waiting) const
{
    const LineTime host = waiting.origin + m_line.hostAllowance();
    const LineTime base = host + timing::processing(request.packet.instruction);
    if (request.shape == ReplyShape::None)
        return base;
    if (request.shape == ReplyShape::Anyone) {
        const auto replies = static_cast<LineTime::rep>(collector.answers());
        const auto replySize = static_cast<LineTime::rep>(timing::largestStatus(3));
        return base + (waiting.highestId + 1) * timing::SlotOfBroadcastPing
            + replies * (replySize * m_line.byteTime() + Traits().returnDelay);
    }
    const std::uint8_t next = request.replies[collector.position()].id;
    const Traits device = traits(next);
    // Nothing is expected of a device that is told to be silent: no need to wait until it has written its EEPROM.
    const bool silent = device.statusReturnLevel < 2 && request.isWrite();
    const LineTime firstByte = 2 * m_line.byteTime();
    return (silent ? host + timing::processing(Instruction::Read) : base) + device.returnDelay + firstByte;
}

/// At a low Status Return Level silence is what was to be expected.
void Bus::explainSilence(const Request &request, ExchangeResult &result) const
{
    if (request.packet.instruction == Instruction::Ping)
        return;
    const bool isRead = !request.isWrite();
    for (std::size_t i = 0; i < result.replies.size(); ++i) {
        Result<Reply> &reply = result.replies[i];
        if (reply || reply.error().kind != ErrorKind::NothingReceived)
            continue;
        const std::uint8_t id = request.replies[i].id;
        const int level = traits(id).statusReturnLevel;
        if (!isRead && level < 2)
            reply = Reply{id, DeviceError::None, false, {}, m_line.now()};
        else if (isRead && level < 1)
            reply = tl::unexpected(messages::silentByLevel(id, level));
    }
}

void Bus::count(const ExchangeResult &result)
{
    ++m_statistics.exchanges;
    m_statistics.bytesReceived += result.seen.bytesReceived;
    m_statistics.strays += static_cast<quint64>(result.seen.strayPackets);
    m_statistics.crcErrors += static_cast<quint64>(result.seen.damagedPackets);
    for (const Result<Reply> &reply : result.replies) {
        if (reply) {
            ++m_statistics.replies;
            continue;
        }
        switch (reply.error().kind) {
        case ErrorKind::Refused: ++m_statistics.replies; break;
        case ErrorKind::WrongLength: ++m_statistics.lengthErrors; break;
        case ErrorKind::DamagedCrc: break;
        default: ++m_statistics.timeouts; break;
        }
    }
}

Result<void> Bus::settleFor(LineTime quiet, LineTime limit, bool heedStop)
{
    const LineTime end = m_line.now() + limit;
    LineTime silentSince = m_line.now();
    while (m_line.now() < end && m_line.now() - silentSince < quiet) {
        if (Result<void> may = heedStop ? mayWait() : Result<void>(); !may)
            return may;
        if (Result<void> read = receive(std::min({end, silentSince + quiet, m_line.now() + timing::Slice})); !read)
            return read;
        if (m_received.empty())
            continue;
        silentSince = m_line.now();
        m_statistics.bytesReceived += m_received.size();
    }
    m_line.discardInput();
    return {};
}

Result<void> Bus::setBaudRate(int bitsPerSecond)
{
    if (bitsPerSecond == m_line.baudRate())
        return {};
    if (m_sentBy + DrainMargin > m_line.now()) {
        if (Result<void> drained = waitUntil(m_sentBy + std::min(DrainMargin, m_line.hostAllowance()), false); !drained)
            return drained;
    }
    if (Result<void> set = keep(m_line.setBaudRate(bitsPerSecond)); !set)
        return set;
    m_line.discardInput();
    if (Result<void> waited = waitUntil(m_line.now() + 2 * m_line.byteTime(), false); !waited)
        return waited;
    m_line.discardInput();
    return {};
}

/// What comes meanwhile is discarded.
Result<void> Bus::waitUntil(LineTime time, bool heedStop)
{
    while (m_line.now() < time) {
        if (Result<void> may = heedStop ? mayWait() : Result<void>(); !may)
            return may;
        if (Result<void> read = receive(std::min(time, m_line.now() + timing::Slice)); !read)
            return read;
        m_statistics.bytesReceived += m_received.size();
    }
    return {};
}

Result<void> Bus::receive(LineTime until)
{
    m_received.clear();
    return keep(m_line.read(m_received, until));
}

/// Remembers that the line is gone.
Result<void> Bus::keep(Result<void> result)
{
    if (!result && result.error().kind == ErrorKind::PortLost)
        m_lost = result.error();
    return result;
}

} // namespace dynascope
