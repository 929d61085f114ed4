// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/packetassembler.h"

#include "core/protocol/packet.h"

#include <algorithm>
#include <array>

namespace dynascope::sim {
namespace {

constexpr std::array<std::uint8_t, 4> Header{0xFF, 0xFF, 0xFD, 0x00};

bool mayBeginPacket(ByteView bytes)
{
    const std::size_t known = std::min(bytes.size(), Header.size());
    return std::ranges::equal(bytes.first(known), ByteView(Header).first(known));
}

} // namespace

void PacketAssembler::feed(ByteView bytes, LineTime now)
{
    m_buffer.insert(m_buffer.end(), bytes.begin(), bytes.end());
    m_fed = now;
}

std::optional<Bytes> PacketAssembler::next(LineTime now)
{
    if (m_buffer.empty())
        return std::nullopt;
    if (mayBeginPacket(m_buffer)) {
        const bool known = m_buffer.size() >= HeaderSize;
        const std::size_t size = known ? HeaderSize + littleEndian(ByteView(m_buffer).subspan(LengthAt), 2) : 0;
        const bool plausible = size <= MaximumPacketSize;
        if (known && plausible && m_buffer.size() >= size)
            return take(size);
        if (plausible)
            return now >= m_fed + m_patience ? std::optional(take(m_buffer.size())) : std::nullopt;
    }
    std::size_t noise = 1;
    while (noise < m_buffer.size() && !mayBeginPacket(ByteView(m_buffer).subspan(noise)))
        ++noise;
    return take(noise);
}

std::optional<LineTime> PacketAssembler::deadline() const
{
    return m_buffer.empty() ? std::nullopt : std::optional(m_fed + m_patience);
}

Bytes PacketAssembler::take(std::size_t bytes)
{
    const auto end = m_buffer.begin() + static_cast<std::ptrdiff_t>(bytes);
    Bytes taken(m_buffer.begin(), end);
    m_buffer.erase(m_buffer.begin(), end);
    return taken;
}

} // namespace dynascope::sim
