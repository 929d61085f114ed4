// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/collector.h"

#include "core/bus/messages.h"
#include "core/bus/timing.h"
#include "core/protocol/crc16.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t IdAt = 4;

} // namespace

void Collector::begin(const Request &request, ByteView sent, Found found)
{
    m_request = &request;
    m_earlier[m_turn++ % m_earlier.size()].assign(sent.begin(), sent.end());
    m_sent = sent;
    m_found = std::move(found);
    m_parser.reset();
    m_parser.setMaximumSize(timing::largestPacket(request, sent.size()));
    m_slotCount = request.replies.size();
    m_slots.resize(std::max(m_slots.size(), m_slotCount));
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        m_slots[i].expected = request.replies[i];
        m_slots[i].state = Slot::State::Open;
    }
    m_seen.reset();
    m_foreign.reset();
    m_cutOff.reset();
    m_lastPacketAt.reset();
    m_turnAt.reset();
    m_belated.clear();
    m_answers = 0;
    m_echoExpected = false;
}

void Collector::feed(ByteView bytes, LineTime at)
{
    m_seen.bytesReceived += bytes.size();
    m_parser.feed(bytes);
    drain(at);
}

void Collector::giveUp(LineTime at)
{
    const Parser::Pending pending = m_parser.pending();
    if (pending.have > 0) {
        if (!m_cutOff || pending.have > m_cutOff->have)
            m_cutOff = pending;
        if (m_request->shape == ReplyShape::Fast)
            salvageBlocks(m_parser.buffered(), at);
    }
    m_parser.giveUp();
    drain(at);
}

void Collector::drain(LineTime at)
{
    while (const auto event = m_parser.next()) {
        if (const auto *packet = std::get_if<Parser::Packet>(&*event)) {
            if (m_heard)
                m_heard(at, packet->raw);
            take(*packet, at);
        } else if (const auto *damaged = std::get_if<Parser::Damaged>(&*event)) {
            if (m_heard)
                m_heard(at, damaged->raw);
            takeDamaged(damaged->raw, at);
        }
    }
    m_seen.noiseBytes = m_parser.noiseBytes();
}

void Collector::take(const Parser::Packet &packet, LineTime at)
{
    if (!packet.isStatus()) { // never an answer; our own packet where the adapter returns what was sent
        if (std::ranges::equal(packet.raw, m_sent) && !m_seen.echo)
            m_seen.echo = true;
        else if (std::ranges::any_of(m_earlier, [&](const Bytes &own) { return std::ranges::equal(packet.raw, own); }))
            stray(packet, at); // the echo of one of ours, late
        else
            takeForeign(packet, at);
    } else if (packet.isFastStatus()) {
        takeFast(packet, at);
    } else if (m_request->shape == ReplyShape::Anyone) {
        takeAnyone(packet, at);
    } else {
        takeStatus(packet, at);
    }
}

/// Another controller speaks on this wire: who it asks may answer it, not us.
void Collector::takeForeign(const Parser::Packet &packet, LineTime at)
{
    if (packet.id == BroadcastId)
        m_foreign.set();
    else
        m_foreign.set(packet.id);
    stray(packet, at);
}

void Collector::takeFast(const Parser::Packet &packet, LineTime at)
{
    if (m_request->shape != ReplyShape::Fast) {
        stray(packet, at);
        return;
    }
    salvageBlocks(packet.raw, at);
    // A good packet; but what of it is not of the shape that was asked for?
    std::size_t block = HeaderSize + 1;
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        Slot &slot = m_slots[i];
        if (slot.state == Slot::State::Open) {
            if (block + 1 < packet.raw.size() && packet.raw[block + 1] != slot.expected.id) {
                ++m_seen.strayPackets;
                m_seen.strayIds.push_back(packet.raw[block + 1]);
            } else {
                slot.length = packet.parameters.size();
                slot.state = Slot::State::WrongLength;
            }
            break;
        }
        block += slot.expected.length + std::size_t(FastBlockOverhead);
    }
    m_lastPacketAt = at;
}

void Collector::takeStatus(const Parser::Packet &status, LineTime at)
{
    Slot *slot = m_request->shape == ReplyShape::Fast ? nullptr : slotOf(status.id);
    if (!slot || slot->answered()) {
        stray(status, at);
        return;
    }
    if (isDoubtful(*slot, status, at))
        return;
    if (!status.isError() && status.parameters.size() != slot->expected.length) {
        slot->length = status.parameters.size(); // the right one may follow
        pass(*slot, Slot::State::WrongLength, at);
        return;
    }
    doubtLaterOnes(*slot);
    accept(*slot, status.errorField, status.parameters, at, status.raw.size());
    pass(*slot, Slot::State::Answered, at);
}

/// Devices answer in the order of the request: what came from a later one before this was no answer to it.
void Collector::doubtLaterOnes(const Slot &slot)
{
    for (std::size_t i = m_slotCount; i > 0 && &m_slots[i - 1] != &slot; --i) {
        if (!m_slots[i - 1].answered())
            continue;
        m_slots[i - 1].state = Slot::State::Doubtful;
        --m_answers;
        ++m_seen.strayPackets;
        m_seen.strayIds.push_back(m_slots[i - 1].expected.id);
    }
}

void Collector::pass(Slot &slot, Slot::State state, LineTime at)
{
    slot.state = state;
    m_lastPacketAt = at;
    const bool isLast = &slot == &m_slots[m_slotCount - 1];
    if (m_request->shape == ReplyShape::Anyone || (m_request->shape == ReplyShape::InOrder && !isLast))
        m_turnAt = at;
}

/// Is it an answer that may be an earlier request's? Then the right one may follow. An answer to an earlier Ping says
/// what one to this says; but it proves nothing of what else is under way.
bool Collector::isDoubtful(Slot &slot, const Parser::Packet &status, LineTime at)
{
    const std::size_t length = status.parameters.size();
    if (m_foreign.test(status.id)) {
        if (slot.state == Slot::State::Open)
            slot.state = Slot::State::Doubtful;
        return true;
    }
    if (!m_late.couldBe(status.id, length, status.isError())) {
        if (status.isError() || length == slot.expected.length)
            m_late.clear(status.id, at);
        return false;
    }
    if (m_request->packet.instruction == Instruction::Ping && !status.isError() && length == slot.expected.length
        && !m_late.couldFakePing(status.id))
        return false;
    if (!status.isError() && length != slot.expected.length)
        m_belated.push_back({status.id, at - m_late.originOf(status.id, length).value_or(at)});
    if (slot.state == Slot::State::Open)
        slot.state = Slot::State::Doubtful;
    ++m_seen.lateAnswers;
    return true;
}

void Collector::takeAnyone(const Parser::Packet &status, LineTime at)
{
    const bool isAnswer = !status.isError() && status.parameters.size() == PingReplyLength && !m_late.couldFakePing(status.id);
    if (!isAnswer || slotOf(status.id)) {
        stray(status, at); // a second answer under one ID: two devices share it
        return;
    }
    if (m_slots.size() == m_slotCount)
        m_slots.emplace_back();
    Slot &slot = m_slots[m_slotCount++];
    slot.expected = {status.id, PingReplyLength};
    accept(slot, status.errorField, status.parameters, at, status.raw.size());
    pass(slot, Slot::State::Answered, at);
    if (m_found)
        m_found(slot.reply);
}

void Collector::accept(Slot &slot, std::uint8_t errorField, ByteView data, LineTime at, std::size_t bytes)
{
    slot.reply.id = slot.expected.id;
    slot.reply.error = static_cast<DeviceError>(errorField & ~AlertBit);
    slot.reply.alert = (errorField & AlertBit) != 0;
    slot.reply.at = at;
    slot.reply.bytes = bytes;
    slot.reply.data.clear();
    if (slot.reply.error == DeviceError::None)
        slot.reply.data.assign(data.begin(), data.end());
    ++m_answers;
}

void Collector::takeDamaged(ByteView raw, LineTime at)
{
    ++m_seen.damagedPackets;
    m_seen.damagedIds.push_back(raw[IdAt]);
    if (m_request->shape == ReplyShape::Fast)
        salvageBlocks(raw, at);
    if (m_slotCount == 0 || m_request->shape == ReplyShape::Anyone)
        return;
    // The ID that stands in it may itself be damaged; then it was the turn of the next one.
    Slot *slot = m_request->shape == ReplyShape::Fast ? nullptr : slotOf(raw[IdAt]);
    if (!slot || slot->answered())
        slot = &m_slots[position()];
    if (slot->answered())
        return;
    pass(*slot, Slot::State::Damaged, at);
}

/// A fast reply, whole or not: block i counts when it carries the i-th ID and its CRC, which covers all bytes up to
/// there, holds. Manual: "Fast Sync Read", "Fast Bulk Read".
void Collector::salvageBlocks(ByteView raw, LineTime at)
{
    constexpr std::size_t BlocksAt = HeaderSize + 1;
    if (raw.size() < BlocksAt || raw[IdAt] != BroadcastId
        || raw[HeaderSize] != static_cast<std::uint8_t>(Instruction::Status))
        return;
    const std::size_t announced = HeaderSize + littleEndian(raw.subspan(HeaderSize - 2), 2);
    const bool doubtful = m_late.couldBeFast(announced) || m_foreign.any();
    std::size_t begin = BlocksAt;
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        Slot &slot = m_slots[i];
        const std::size_t dataAt = begin + 2;
        const std::size_t crcAt = dataAt + slot.expected.length;
        if (raw.size() < crcAt + 2 || raw[begin + 1] != slot.expected.id
            || crc16(raw.first(crcAt)) != littleEndian(raw.subspan(crcAt), 2))
            return;
        begin = crcAt + 2;
        if (slot.answered())
            continue;
        if (doubtful) {
            slot.state = Slot::State::Doubtful;
            ++m_seen.lateAnswers;
            continue;
        }
        m_late.clear(BroadcastId, at);
        accept(slot, raw[dataAt - 2], raw.subspan(dataAt, slot.expected.length), at, begin - dataAt + 2);
        pass(slot, Slot::State::Answered, at);
    }
}

void Collector::stray(const Parser::Packet &packet, LineTime at)
{
    if (packet.isStatus() && !packet.isFastStatus()) {
        if (const auto origin = m_late.originOf(packet.id, packet.parameters.size())) {
            m_belated.push_back({packet.id, at - *origin});
            ++m_seen.lateAnswers;
        }
    }
    ++m_seen.strayPackets;
    m_seen.strayIds.push_back(packet.id);
}

Collector::Slot *Collector::slotOf(std::uint8_t id)
{
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        if (m_slots[i].expected.id == id)
            return &m_slots[i];
    }
    return nullptr;
}

bool Collector::isComplete() const
{
    switch (m_request->shape) {
    case ReplyShape::None: return !m_echoExpected || m_seen.echo;
    case ReplyShape::Anyone: return false; // nobody knows how many there are
    case ReplyShape::Single: return m_slotCount == 0 || m_slots.front().answered();
    case ReplyShape::InOrder: // behind the last one nobody answers; but one that is still missing may make it doubtful
        for (std::size_t i = 0; i < m_slotCount; ++i) {
            if (!m_slots[i].passed())
                return false;
        }
        return m_slotCount == 0 || m_slots[m_slotCount - 1].answered();
    case ReplyShape::Fast: return m_answers == m_slotCount;
    }
    return true;
}

int Collector::lastId() const
{
    int last = -1;
    for (std::size_t i = 0; i < m_slotCount; ++i)
        last = std::max(last, static_cast<int>(m_slots[i].expected.id));
    return last;
}

std::size_t Collector::position() const
{
    for (std::size_t i = m_slotCount; i > 0; --i) {
        if (m_slots[i - 1].passed())
            return std::min(i, m_slotCount - 1);
    }
    return 0;
}

int Collector::brokenAt() const
{
    std::size_t open = 0;
    if (m_request->shape == ReplyShape::Fast) { // one packet: the first block that is missing
        while (open < m_slotCount && m_slots[open].answered())
            ++open;
        return open < m_slotCount ? static_cast<int>(open) : -1;
    }
    // Behind the last device that was heard nobody was: the first of them broke the chain, unless the one before it was
    // heard so badly that the others may not have heard it either.
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        if (m_slots[i].passed())
            open = i + 1;
    }
    if (open == m_slotCount)
        return -1;
    const bool damaged = open > 0 && !m_slots[open - 1].answered();
    return static_cast<int>(damaged ? open - 1 : open);
}

void Collector::finish(ExchangeResult &result, LineTime waited)
{
    result.brokenAt = brokenAt();
    result.replies.resize(m_slotCount);
    for (std::size_t i = 0; i < m_slotCount; ++i) {
        Slot &slot = m_slots[i];
        Result<Reply> &reply = result.replies[i];
        const int index = static_cast<int>(i);
        if (slot.answered() && slot.reply.error == DeviceError::None) {
            if (!reply)
                reply = Reply();
            std::swap(*reply, slot.reply); // both keep their memory
        } else if (slot.answered()) {
            reply = tl::unexpected(messages::refused(slot.expected.id, slot.reply.error));
        } else if (result.brokenAt >= 0 && index > result.brokenAt && !slot.passed()) {
            const std::uint8_t culprit = m_slots[static_cast<std::size_t>(result.brokenAt)].expected.id;
            reply = tl::unexpected(messages::chainBroken(slot.expected.id, culprit));
        } else {
            reply = tl::unexpected(missing(slot, index == result.brokenAt, waited));
        }
    }
    std::swap(result.seen, m_seen);
}

Error Collector::missing(const Slot &slot, bool blamed, LineTime waited) const
{
    const std::uint8_t id = slot.expected.id;
    switch (slot.state) {
    case Slot::State::WrongLength: return messages::wrongLength(id, slot.length, slot.expected.length);
    case Slot::State::Damaged: return messages::damagedCrc(id);
    case Slot::State::Doubtful: return messages::onlyLate(id);
    default: break;
    }
    if (blamed && m_cutOff)
        return messages::cutOff(id, m_cutOff->have, m_cutOff->want);
    if (blamed && !m_seen.strayIds.empty())
        return messages::wrongId(id, m_seen.strayIds);
    if (blamed && m_seen.noiseBytes > 0)
        return messages::noHeader(id, m_seen.noiseBytes);
    return messages::nothingReceived(id, waited);
}

} // namespace dynascope
