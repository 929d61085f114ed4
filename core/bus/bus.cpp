// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/bus.h"

#include "core/bus/asking.h"
#include "core/bus/buswaiting.h"
#include "core/bus/messages.h"
#include "core/bus/remainder.h"
#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime SettleLimit = 50ms;

} // namespace

void Bus::setTraits(const std::vector<Traits> &traits)
{
    m_known.reset();
    m_moreTraits.clear();
    for (const Traits &device : traits)
        addTraits(device);
}

void Bus::addTraits(const Traits &device)
{
    if (!m_known.test(device.id) || m_traits[device.id].baudRate == device.baudRate) {
        m_known.set(device.id);
        m_traits[device.id] = device;
        return;
    }
    std::erase_if(m_moreTraits, [&device](const Traits &other) {
        return other.id == device.id && other.baudRate == device.baudRate;
    });
    m_moreTraits.push_back(device);
}

Traits Bus::traits(std::uint8_t id) const
{
    const int rate = m_channel.line().baudRate();
    const auto holds = [id, rate](const Traits &device) {
        return device.id == id && (device.baudRate == AnyRate || device.baudRate == rate);
    };
    if (m_known.test(id) && holds(m_traits[id]))
        return m_traits[id];
    if (const auto other = std::ranges::find_if(m_moreTraits, holds); other != m_moreTraits.end())
        return *other;
    Traits fresh;
    fresh.id = id;
    fresh.baudRate = rate;
    return fresh;
}

void Bus::setTap(Tap tap)
{
    m_tap = std::move(tap);
    m_collector.setHeard(!m_tap ? Collector::Heard() : [this](LineTime at, ByteView bytes) {
        m_tap(Direction::Received, at, bytes);
    });
}

Result<ExchangeResult> Bus::exchange(const Request &request, int retries)
{
    const Bytes packet = encode(request.packet);
    if (packet.size() > MaximumPacketSize)
        return tl::unexpected(messages::packetTooLong(packet.size(), MaximumPacketSize));
    ExchangeResult total;
    if (Result<void> done = exchangeInto(request, packet, total); !done)
        return tl::unexpected(done.error());
    if (!request.isIdempotent())
        return total;
    for (int retry = 0; retry < retries; ++retry) {
        const Remainder rest = remainderOf(request, total);
        if (rest.indices.empty())
            break;
        ExchangeResult again;
        const Result<Reply> &first = total.replies[rest.indices.front()];
        const bool isSilent = !first && first.error().kind == ErrorKind::NothingReceived;
        if (!isSilent || !isExpectedSilence(rest.request))
            m_quality.countRetry(rest.request);
        if (Result<void> done = exchangeInto(rest.request, encode(rest.request.packet), again); !done)
            return tl::unexpected(done.error());
        ++total.seen.retries;
        merge(total, std::move(again), rest.indices);
    }
    return total;
}

Result<void> Bus::exchangeInto(const Request &request, ByteView packet, ExchangeResult &result)
{
    if (Result<void> ready = prepare(); !ready)
        return ready;
    if (m_late.concern(request) && !isMute(request, request.replies.front().id)) {
        const std::uint8_t first = request.replies.front().id;
        const Result<bool> proven = fence(first);
        if (!proven)
            return tl::unexpected(proven.error());
        if (!*proven) { // whoever doesn't answer a Ping would break the chain, too
            result.seen.reset();
            result.brokenAt = 0;
            const int level = traits(first).statusReturnLevel;
            const bool byLevel = level < 1 && request.packet.instruction != Instruction::Ping;
            result.replies.assign(request.replies.size(), tl::unexpected(byLevel ? messages::silentByLevel(first, level)
                                                                                 : messages::notSent(first)));
            for (std::size_t i = 1; i < request.replies.size(); ++i)
                result.replies[i] = tl::unexpected(
                    messages::chainBroken(request.replies[i].id, first));
            explainSilence(request, result);
            return {};
        }
        if (Result<void> ready = prepare(); !ready)
            return ready;
    }
    Waiting waiting;
    return perform(request, packet, waiting, result);
}

Result<ExchangeResult> Bus::broadcastPing(int highestId, const Collector::Found &found)
{
    Waiting waiting;
    waiting.highestId = std::clamp(highestId, 0, static_cast<int>(MaximumId));
    waiting.found = found;
    if (Result<void> ready = prepare(); !ready)
        return tl::unexpected(ready.error());
    const Request request = pingRequest(BroadcastId);
    ExchangeResult result;
    if (Result<void> done = perform(request, encode(request.packet), waiting, result); !done)
        return tl::unexpected(done.error());
    return result;
}

/// Adapters delay, but keep the order: one answered Ping proves that nothing older is in flight. Where an earlier Ping
/// is itself unanswered, a Read of a length that nobody waits for. A refusal proves it as well. False: no answer came.
Result<bool> Bus::fence(std::uint8_t id)
{
    const std::uint16_t distinct = m_late.couldBePing(id) ? m_late.distinctLength(id) : 0;
    const Request request = distinct > 0 ? readRequest({id, 0, distinct}) : pingRequest(id);
    const Asking asking(*this); // it was silent before
    Waiting waiting;
    ExchangeResult result;
    if (Result<void> done = perform(request, encode(request.packet), waiting, result); !done)
        return tl::unexpected(done.error());
    const Result<Reply> &reply = result.replies.front();
    return (reply || reply.error().kind == ErrorKind::Refused) && !m_late.couldBePing(id);
}

Result<void> Bus::perform(const Request &request, ByteView packet, Waiting &waiting, ExchangeResult &result)
{
    m_collector.begin(request, packet, std::move(waiting.found));
    if (m_echoes)
        m_collector.expectEcho();
    waiting.begin = m_channel.now();
    if (const Result<LineTime> begun = begin(packet); !begun)
        return tl::unexpected(begun.error());
    waiting.sent = waiting.origin = m_channel.sentBy();
    m_answerEnd = answerEnd(request, waiting.sent);
    const Result<void> listened = listen(request, waiting);
    const Observations &seen = m_collector.seen();
    carried(packet.size() + seen.bytesReceived - (seen.echo ? std::min(packet.size(), seen.bytesReceived) : 0));
    if (!listened) {
        m_unsettled = true;
        m_late.addAll(request, waiting.sent);
        return listened;
    }
    const LineTime last = m_collector.lastPacketAt().value_or(m_channel.now());
    m_unsettled = m_collector.isMidPacket();
    m_collector.finish(result, m_channel.now() - waiting.origin);
    result.seen.roundTrip = last - waiting.begin;
    explainSilence(request, result);
    m_echoes = m_echoes || result.seen.echo;
    const auto hasCome = [](const Result<Reply> &reply) { return reply && reply->bytes > 0; };
    if (!result.replies.empty() && std::ranges::all_of(result.replies, hasCome) && !mayBeEarlierPings(request, result))
        m_channel.noteAnswered();
    learn(request, result, waiting.sent);
    remember(request, result, waiting.sent);
    for (const ExpectedReply &reply : request.replies)
        m_askedAt[reply.id] = waiting.sent;
    if (request.shape == ReplyShape::Anyone)
        m_askedAt[BroadcastId] = waiting.sent;
    m_quality.count(request, result, waiting.sent, isExpectedSilence(request));
    for (const Result<Reply> &reply : result.replies) {
        if (reply && reply->bytes > 0)
            m_heardAt[reply->id] = reply->at;
    }
    return {};
}

/// What was missing may still come.
void Bus::remember(const Request &request, const ExchangeResult &result, LineTime sent)
{
    const bool anyLost = std::ranges::any_of(result.replies, isMissing);
    m_late.addMissing(request, result, sent); // also of who is thought to answer no Read: somebody may have told it to
    for (std::size_t i = 0; i < result.replies.size() && i < request.replies.size(); ++i) {
        if (isMissing(result.replies[i]) && !result.isHidden(i))
            m_timing.missed(request.replies[i].id);
    }
    if (request.shape == ReplyShape::Anyone)
        m_late.addPings(sent);
    m_unsettled = m_unsettled || anyLost || result.seen.strayPackets > 0 || result.seen.noiseBytes > 0;
}

/// From the answers of devices that have only themselves to wait for: behind another's answer an adapter that hands
/// over by the piece makes it look as if they had come at once.
void Bus::learn(const Request &request, const ExchangeResult &result, LineTime sent)
{
    const LineTime byteTime = m_channel.line().byteTime();
    for (const Collector::Belated &late : m_collector.belated())
        m_timing.learn(late.id, late.by - timing::times(StatusOverhead, byteTime) - traits(late.id).returnDelay);
    if (request.isWrite() || request.shape == ReplyShape::Anyone || result.replies.empty() || !result.replies.front())
        return;
    const Reply &first = *result.replies.front();
    const bool cut = request.shape == ReplyShape::Fast && result.brokenAt >= 0; // nobody knows where it ended
    if (first.bytes == 0 || cut || mayBeEarlierPings(request, result))
        return;
    const std::size_t bytes = request.shape == ReplyShape::Fast ? request.maximumReplySize() : first.bytes;
    m_timing.learn(first.id, first.at - timing::times(bytes, byteTime) - sent - traits(first.id).returnDelay);
}

void Bus::carried(std::size_t bytes)
{
    m_quality.totals().busy += timing::times(bytes, m_channel.line().byteTime());
}

/// Nothing that belongs to an earlier request may be taken for the answer to the next one.
Result<void> Bus::prepare()
{
    if (isStopped())
        return tl::unexpected(messages::stopped());
    if (isCancelled())
        return tl::unexpected(messages::cancelled());
    const Result<ByteView> waiting = m_channel.receive(m_channel.now());
    if (!waiting)
        return tl::unexpected(waiting.error());
    if (!waiting->empty()) {
        m_channel.countDiscarded(waiting->size());
        carried(waiting->size());
        if (std::ranges::equal(*waiting, m_channel.lastSent())) // the echo of a request that nobody answers
            m_echoes = true;
        else
            m_unsettled = true;
        learnBelated(*waiting);
    }
    m_late.forgetOld(m_channel.now());
    if (!m_unsettled)
        return {};
    const LineTime quiet = timing::silence(m_channel.line());
    const LineTime sofar = std::max(LineTime(), m_channel.now() - m_channel.busyUntil());
    if (Result<void> settled = m_channel.settle(quiet - std::min(quiet, sofar), SettleLimit);
        !settled)
        return settled;
    m_unsettled = false;
    return {};
}

/// An adapter may be slower than anybody waits: its answers come while the line idles.
void Bus::learnBelated(ByteView bytes)
{
    if (m_late.isEmpty())
        return;
    m_idle.reset();
    m_idle.feed(bytes);
    while (const auto event = m_idle.next()) {
        const auto *packet = std::get_if<Parser::Packet>(&*event);
        if (!packet || !packet->isStatus())
            continue;
        if (const auto origin = m_late.originOf(packet->id, packet->parameters.size()))
            m_timing.learn(packet->id, m_channel.lastByteAt() - *origin);
    }
}

Result<void> Bus::setBaudRate(int bitsPerSecond)
{
    const int before = line().baudRate();
    Result<void> set = m_channel.setBaudRate(bitsPerSecond);
    if (line().baudRate() != before)
        m_late.rateChanged();
    return set;
}

Result<LineTime> Bus::begin(ByteView packet)
{
    Result<LineTime> begun = m_channel.send(packet);
    if (begun && m_tap)
        m_tap(Direction::Sent, *begun, packet);
    return begun;
}

Result<void> Bus::sendOnly(ByteView packet)
{
    if (const Result<LineTime> begun = begin(packet); !begun)
        return tl::unexpected(begun.error());
    m_unsettled = true;
    carried(packet.size());
    return m_channel.waitUntil(m_channel.sentBy(), Channel::Heed::Nothing);
}

Result<void> Bus::letEnd(LineTime pause, LineTime limit)
{
    const LineTime end = m_channel.now() + limit;
    LineTime until = m_channel.now();
    do {
        const Result<ByteView> received = m_channel.receive(std::min(until, end));
        if (!received)
            return tl::unexpected(received.error());
        m_channel.countDiscarded(received->size());
        until = m_channel.busyUntil() + pause;
        if (!m_channel.isAnswered())
            until = std::max(until, m_answerEnd + pause);
    } while (m_channel.now() < std::min(until, end));
    m_channel.line().discardInput();
    return {};
}

Result<void> Bus::listen(const Request &request, Waiting &waiting)
{
    const Line &line = m_channel.line();
    if (request.shape == ReplyShape::None && !m_echoes)
        return m_channel.waitUntil(waiting.sent, Channel::Heed::Orders);
    waiting.limit = longestWait(request, waiting);
    while (!m_collector.isComplete()) {
        if (Result<void> may = m_channel.mayWait(); !may)
            return may;
        const LineTime now = m_channel.now();
        LineTime until = deadline(request, waiting);
        if (m_collector.isMidPacket()) {
            until = std::min(waiting.lastByte + timing::silence(line) + allowance(request), waiting.limit);
            if (now >= until) {
                m_collector.giveUp(waiting.lastByte);
                continue;
            }
        } else {
            // Somebody else's packet or noise held the wire when the answer was due.
            if (m_collector.seen().bytesReceived > 0)
                until = std::max(until, std::min(waiting.limit, waiting.lastByte + 10 * line.byteTime()));
            if (now >= until)
                break;
        }
        const Result<ByteView> received = m_channel.receive(std::min(until, now + timing::Slice));
        if (!received)
            return tl::unexpected(received.error());
        if (received->empty())
            continue;
        waiting.lastByte = m_channel.now();
        m_collector.feed(*received, waiting.lastByte);
        if (const auto turnAt = m_collector.turnAt())
            waiting.origin = std::max(waiting.origin, *turnAt);
    }
    return {};
}

std::optional<std::vector<std::uint8_t>> Bus::othersAlive(std::uint8_t but) const
{
    static constexpr LineTime Lately = 10s;
    const auto isLately = [this](LineTime at) { return at > LineTime() && m_channel.now() - at < Lately; };
    std::vector<std::uint8_t> ids;
    bool asked = false;
    for (std::size_t id = 0; id < m_heardAt.size(); ++id) {
        if (id == but)
            continue;
        asked = asked || isLately(m_askedAt[id]);
        if (isLately(m_heardAt[id]))
            ids.push_back(static_cast<std::uint8_t>(id));
    }
    if (ids.empty() && !asked)
        return std::nullopt;
    return ids;
}

BusStatistics Bus::statistics() const
{
    BusStatistics statistics = m_quality.totals();
    statistics.bytesSent = m_channel.bytesSent();
    statistics.bytesReceived += m_channel.bytesDiscarded();
    return statistics;
}

LineQuality Bus::quality() const
{
    LineQuality quality = m_quality.snapshot();
    quality.totals = statistics();
    return quality;
}

} // namespace dynascope
