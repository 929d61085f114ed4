// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/parser.h"

#include "core/protocol/crc16.h"
#include "core/protocol/stuffing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dynascope {
namespace {

constexpr std::array<std::uint8_t, 4> Header{0xFF, 0xFF, 0xFD, 0x00};
constexpr std::size_t IdAt = 4;
constexpr std::size_t SmallestLength = 3;       ///< INST, CRC
constexpr std::size_t SmallestStatusLength = 4; ///< INST, ERR, CRC

/// How many of the first bytes of `view` agree with a header.
std::size_t headerMatch(ByteView view)
{
    std::size_t n = 0;
    while (n < Header.size() && n < view.size() && view[n] == Header[n])
        ++n;
    return n;
}

} // namespace

StatusPacket Parser::Packet::status() const
{
    return {id, static_cast<DeviceError>(errorField & ~AlertBit), (errorField & AlertBit) != 0,
        Bytes(parameters.begin(), parameters.end())};
}

void Parser::feed(ByteView bytes)
{
    if (m_begin > 0) {
        m_buffer.erase(m_buffer.begin(), m_buffer.begin() + static_cast<std::ptrdiff_t>(m_begin));
        m_begin = 0;
    }
    m_buffer.insert(m_buffer.end(), bytes.begin(), bytes.end());
}

std::optional<Parser::Event> Parser::next()
{
    const bool found = seekHeader();
    const std::optional<std::size_t> size = found ? announcedSize() : std::nullopt;
    const bool whole = size && buffered().size() >= *size;
    // Noise is told once what follows it is known, so that any chunking of a stream gives the same events.
    if (m_noise > 0 && whole)
        return Noise{std::exchange(m_noise, 0)};
    if (!whole)
        return std::nullopt;
    return takePacket(*size);
}

bool Parser::seekHeader()
{
    while (!buffered().empty()) {
        const ByteView view = buffered();
        const std::size_t match = headerMatch(view);
        if (match == view.size())
            return false; // may yet become a header
        if (match < Header.size()) {
            skip(1);
            continue;
        }
        if (view[IdAt] == 0xFF || view[IdAt] == 0xFD) { // FF FF FD 00 FF…: not an ID
            skip(1);
            continue;
        }
        if (view.size() < HeaderSize)
            return false;
        const std::size_t length = littleEndian(view.subspan(LengthAt), 2);
        if (length < SmallestLength || length + HeaderSize > m_maximumSize) {
            skip(1);
            continue;
        }
        if (view.size() > HeaderSize && view[HeaderSize] == static_cast<std::uint8_t>(Instruction::Status)
            && length < SmallestStatusLength) {
            skip(1);
            continue;
        }
        return true;
    }
    return false;
}

std::optional<std::size_t> Parser::announcedSize() const
{
    const ByteView view = buffered();
    if (view.size() < HeaderSize)
        return std::nullopt;
    return HeaderSize + littleEndian(view.subspan(LengthAt), 2);
}

Parser::Event Parser::takePacket(std::size_t size)
{
    const ByteView raw = buffered().first(size);
    const ByteView covered = raw.first(size - 2);
    if (crc16(covered) != littleEndian(raw.subspan(size - 2), 2)) {
        const Damaged damaged{raw};
        m_damaged = std::max(m_damaged, size);
        skip(1);
        return damaged;
    }
    Packet packet;
    packet.raw = raw;
    packet.id = raw[IdAt];
    packet.instruction = static_cast<Instruction>(raw[HeaderSize]);
    if (packet.isFastStatus()) {
        packet.parameters = raw.subspan(HeaderSize + 1);
    } else {
        ByteView body = covered.subspan(HeaderSize);
        if (isStuffed(body)) {
            Unstuffed unstuffed = unstuff(body);
            packet.forgotStuffing = unstuffed.forgotten;
            m_unstuffed = std::move(unstuffed.body);
            body = m_unstuffed;
        }
        if (packet.isStatus())
            packet.errorField = body[1];
        packet.parameters = body.subspan(packet.isStatus() ? 2 : 1);
    }
    m_begin += size;
    m_damaged -= std::min(m_damaged, size);
    return packet;
}

Parser::Pending Parser::pending() const
{
    const ByteView view = buffered();
    if (headerMatch(view) < Header.size())
        return {};
    return {view.size(), announcedSize().value_or(0)};
}

void Parser::giveUp()
{
    if (!buffered().empty())
        skip(1);
}

void Parser::reset()
{
    m_buffer.clear();
    m_begin = 0;
    m_noise = 0;
    m_allNoise = 0;
    m_damaged = 0;
}

void Parser::skip(std::size_t bytes)
{
    m_begin += bytes;
    const std::size_t told = std::min(bytes, m_damaged); // already reported with the damaged packet around it
    m_damaged -= told;
    m_noise += bytes - told;
    m_allNoise += bytes - told;
}

} // namespace dynascope
