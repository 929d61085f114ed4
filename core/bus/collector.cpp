// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/collector.h"

#include "core/bus/messages.h"
#include "core/bus/timing.h"
#include "core/protocol/crc16.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t PingReplyLength = 3;

} // namespace

Collector::Collector(const Request &request, Bytes sent, Heard heard, Found found)
    : m_request(request)
    , m_sent(std::move(sent))
    , m_heard(std::move(heard))
    , m_found(std::move(found))
    , m_parser(timing::largestPacket(request, m_sent.size()))
{
    for (const ExpectedReply &expected : request.replies)
        m_slots.push_back({expected, std::nullopt, false, std::nullopt});
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
        if (m_request.shape == ReplyShape::Fast)
            salvageBlocks(m_parser.buffered(), at);
    }
    m_parser.giveUp();
    drain(at);
}

void Collector::drain(LineTime at)
{
    while (auto event = m_parser.next()) {
        if (const auto *packet = std::get_if<Parser::Packet>(&*event)) {
            if (m_heard)
                m_heard(at, packet->raw);
            take(*packet, at);
        } else if (const auto *damaged = std::get_if<Parser::Damaged>(&*event)) {
            if (m_heard)
                m_heard(at, damaged->raw);
            takeDamaged(*damaged, at);
        }
    }
    m_seen.noiseBytes = m_parser.noiseBytes();
}

void Collector::take(const Parser::Packet &packet, LineTime at)
{
    if (!packet.isStatus()) { // never an answer; our own packet where the adapter returns what was sent
        if (packet.raw == m_sent && !m_seen.echo)
            m_seen.echo = true;
        else
            stray(packet.id);
        return;
    }
    if (packet.isFastStatus()) {
        if (m_request.shape != ReplyShape::Fast) {
            stray(packet.id);
            return;
        }
        salvageBlocks(packet.raw, at);
        const auto open = std::ranges::find_if(m_slots, [](const Slot &slot) { return !slot.reply; });
        if (open != m_slots.end()) // a good packet, but not of the shape that was asked for
            open->wrongLength = packet.parameters.size();
        m_lastPacketAt = at;
        return;
    }
    if (m_request.shape == ReplyShape::Anyone)
        takeAnyone(packet.status(), at);
    else
        takeStatus(packet.status(), at);
}

void Collector::takeStatus(const StatusPacket &status, LineTime at)
{
    Slot *slot = m_request.shape == ReplyShape::Fast ? nullptr : slotOf(status.id);
    if (!slot || slot->reply) {
        stray(status.id);
        return;
    }
    m_lastPacketAt = at;
    if (status.error == DeviceError::None && status.parameters.size() != slot->expected.length) {
        slot->wrongLength = status.parameters.size(); // perhaps a late one: the right one may follow
        return;
    }
    slot->reply = Reply{status.id, status.error, status.alert, {}, at};
    if (status.error == DeviceError::None)
        slot->reply->data = status.parameters;
    ++m_answers;
}

void Collector::takeAnyone(const StatusPacket &status, LineTime at)
{
    const bool isAnswer = status.error == DeviceError::None && status.parameters.size() == PingReplyLength;
    if (!isAnswer || slotOf(status.id)) {
        stray(status.id); // a second answer under one ID: two devices share it
        return;
    }
    m_lastPacketAt = at;
    ++m_answers;
    Slot slot{
        {status.id, PingReplyLength}, Reply{status.id, status.error, status.alert, status.parameters, at}, false, {}};
    m_slots.push_back(slot);
    if (m_found)
        m_found(*slot.reply);
}

void Collector::takeDamaged(const Parser::Damaged &damaged, LineTime at)
{
    ++m_seen.damagedPackets;
    m_seen.damagedIds.push_back(damaged.raw[4]);
    if (m_request.shape == ReplyShape::Fast)
        salvageBlocks(damaged.raw, at);
    if (m_slots.empty() || m_request.shape == ReplyShape::Anyone)
        return;
    // The ID that stands in it may itself be damaged; then it was the turn of the next one.
    Slot *slot = m_request.shape == ReplyShape::Fast ? nullptr : slotOf(damaged.raw[4]);
    if (!slot || slot->reply)
        slot = &m_slots[position()];
    if (slot->reply)
        return;
    slot->damaged = true;
    m_lastPacketAt = at;
}

/// A fast reply, whole or not: block i counts when it carries the i-th ID and its CRC, which covers all bytes up to
/// there, holds. Manual: "Fast Sync Read", "Fast Bulk Read".
void Collector::salvageBlocks(ByteView raw, LineTime at)
{
    constexpr std::size_t BlocksAt = HeaderSize + 1;
    if (raw.size() < BlocksAt || raw[4] != BroadcastId
        || raw[HeaderSize] != static_cast<std::uint8_t>(Instruction::Status))
        return;
    std::size_t begin = BlocksAt;
    for (Slot &slot : m_slots) {
        const std::size_t dataAt = begin + 2;
        const std::size_t crcAt = dataAt + slot.expected.length;
        if (raw.size() < crcAt + 2 || raw[begin + 1] != slot.expected.id
            || crc16(raw.first(crcAt)) != littleEndian(raw.subspan(crcAt), 2))
            return;
        if (!slot.reply) {
            const auto error = static_cast<DeviceError>(raw[begin] & ~AlertBit);
            slot.reply = Reply{slot.expected.id, error, (raw[begin] & AlertBit) != 0, {}, at};
            if (error == DeviceError::None)
                slot.reply->data.assign(raw.begin() + static_cast<std::ptrdiff_t>(dataAt),
                    raw.begin() + static_cast<std::ptrdiff_t>(crcAt));
            ++m_answers;
            m_lastPacketAt = at;
        }
        begin = crcAt + 2;
    }
}

void Collector::stray(std::uint8_t id)
{
    ++m_seen.strayPackets;
    m_seen.strayIds.push_back(id);
}

Collector::Slot *Collector::slotOf(std::uint8_t id)
{
    const auto slot = std::ranges::find_if(m_slots, [id](const Slot &s) { return s.expected.id == id; });
    return slot == m_slots.end() ? nullptr : &*slot;
}

bool Collector::isComplete() const
{
    switch (m_request.shape) {
    case ReplyShape::None: return !m_echoExpected || m_seen.echo;
    case ReplyShape::Anyone: return false; // nobody knows how many there are
    case ReplyShape::Single:
    case ReplyShape::InOrder: return m_slots.empty() || m_slots.back().reply; // behind the last one nobody answers
    case ReplyShape::Fast: return std::ranges::all_of(m_slots, [](const Slot &slot) { return slot.reply.has_value(); });
    }
    return true;
}

std::size_t Collector::position() const
{
    for (std::size_t i = m_slots.size(); i > 0; --i) {
        if (m_slots[i - 1].passed())
            return std::min(i, m_slots.size() - 1);
    }
    return 0;
}

int Collector::brokenAt() const
{
    // Behind the last device that was heard nobody was: the first of them broke the chain.
    std::size_t open = 0;
    for (std::size_t i = 0; i < m_slots.size(); ++i) {
        if (m_slots[i].passed())
            open = i + 1;
    }
    if (m_request.shape == ReplyShape::Fast) { // one packet: the first block that is missing
        const auto first = std::ranges::find_if(m_slots, [](const Slot &slot) { return !slot.reply; });
        open = static_cast<std::size_t>(first - m_slots.begin());
    }
    return open < m_slots.size() ? static_cast<int>(open) : -1;
}

std::vector<Result<Reply>> Collector::replies(LineTime waited) const
{
    std::vector<Result<Reply>> result;
    const int broken = brokenAt();
    for (std::size_t i = 0; i < m_slots.size(); ++i) {
        const Slot &slot = m_slots[i];
        const int index = static_cast<int>(i);
        if (slot.reply && slot.reply->error == DeviceError::None)
            result.push_back(*slot.reply);
        else if (slot.reply)
            result.push_back(tl::unexpected(messages::refused(slot.expected.id, slot.reply->error)));
        else if (broken >= 0 && index > broken && !slot.passed())
            result.push_back(tl::unexpected(
                messages::chainBroken(slot.expected.id, m_slots[static_cast<std::size_t>(broken)].expected.id)));
        else
            result.push_back(tl::unexpected(missing(slot, index == broken, waited)));
    }
    return result;
}

Error Collector::missing(const Slot &slot, bool blamed, LineTime waited) const
{
    const std::uint8_t id = slot.expected.id;
    if (slot.wrongLength)
        return messages::wrongLength(id, *slot.wrongLength, slot.expected.length);
    if (slot.damaged)
        return messages::damagedCrc(id);
    if (blamed && m_cutOff)
        return messages::cutOff(id, m_cutOff->have, m_cutOff->want);
    if (blamed && !m_seen.strayIds.empty())
        return messages::wrongId(id, m_seen.strayIds);
    if (blamed && m_seen.noiseBytes > 0)
        return messages::noHeader(id, m_seen.noiseBytes);
    return messages::nothingReceived(id, waited);
}

} // namespace dynascope
