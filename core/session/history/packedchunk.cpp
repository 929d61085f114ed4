// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history/packedchunk.h"

#include "core/session/history/bits.h"

#include <bit>

namespace dynascope {

namespace {

constexpr std::size_t Blocks = ChunkSize / FineSize;
constexpr std::size_t HeadBytes = Blocks * 2;

unsigned widthOf(const Extremes &block)
{
    return static_cast<unsigned>(std::bit_width(block.span()));
}

} // namespace

PackedChunk::PackedChunk(const OpenChunk &from, HistoryMemory *memory)
    : m_all(from.all)
    , m_fine(from.fine)
    , m_coarse(from.coarse)
    , m_times(memory ? memory->pack(from.at) : std::make_shared<const PackedTimes>(from.at))
{
    packValues(from);
    if (from.gaps.any()) {
        m_gaps.reserve(from.gaps.count());
        for (std::size_t slot = 0; slot < ChunkSize; ++slot) {
            if (from.gaps.test(slot))
                m_gaps.push_back(static_cast<std::uint16_t>(slot));
        }
    }
    const std::size_t bytes = sizeof(PackedChunk) + m_valueBytes + m_fine.heapBytes() + m_coarse.heapBytes()
        + m_gaps.capacity() * sizeof(m_gaps[0]) + 4 * HistoryMemory::Overhead
        + sizeof(Extremes); // and once more in History
    m_charge = MemoryCharge(memory, Detail::Samples, bytes);
}

void PackedChunk::packValues(const OpenChunk &from)
{
    std::size_t pairs = 0; // of bytes: 16 values of n bits are n of those
    for (const Extremes &block : from.fine)
        pairs += widthOf(block);
    m_valueBytes = HeadBytes + 2 * pairs + bits::Spare;
    m_values = std::make_unique<std::byte[]>(m_valueBytes);
    pairs = 0;
    for (std::size_t fine = 0; fine < Blocks; ++fine) {
        const Extremes &block = from.fine[fine];
        const unsigned width = widthOf(block);
        qToLittleEndian<quint16>(static_cast<quint16>(pairs), m_values.get() + 2 * fine);
        for (std::size_t place = 0; place < FineSize; ++place) {
            const auto raw = static_cast<std::uint32_t>(from.raw[fine * FineSize + place]);
            bits::write(m_values.get() + HeadBytes, pairs * 16 + place * width,
                        raw - static_cast<std::uint32_t>(block.minimum));
        }
        pairs += width;
    }
}

PackedChunk::Block PackedChunk::block(std::size_t fine, const Extremes &extremes) const
{
    return {qFromLittleEndian<quint16>(m_values.get() + 2 * fine) * std::size_t(16), widthOf(extremes), extremes.minimum};
}

std::int32_t PackedChunk::value(const Block &block, std::size_t place) const
{
    const std::uint64_t above =
        bits::read(m_values.get() + HeadBytes, block.bit + place * block.width, bits::mask(block.width));
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(block.base) + static_cast<std::uint32_t>(above));
}

std::int32_t PackedChunk::raw(std::size_t slot) const
{
    return value(block(slot / FineSize, m_fine[slot / FineSize]), slot % FineSize);
}

/// What can't reach beyond the result isn't looked at.
void PackedChunk::includeSamples(Extremes &result, std::size_t begin, std::size_t end) const
{
    while (begin < end) {
        const std::size_t fine = begin / FineSize;
        const std::size_t stop = std::min(end, (fine + 1) * FineSize);
        const Extremes all = m_fine[fine];
        if (!result.covers(all)) {
            const Block in = block(fine, all);
            const std::uint64_t mask = bits::mask(in.width);
            std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
            std::uint32_t most = 0;
            for (std::size_t bit = in.bit + begin % FineSize * in.width; begin < stop; ++begin, bit += in.width) {
                const auto above = static_cast<std::uint32_t>(bits::read(m_values.get() + HeadBytes, bit, mask));
                least = std::min(least, above);
                most = std::max(most, above);
            }
            const auto base = static_cast<std::uint32_t>(in.base);
            result.include({static_cast<std::int32_t>(base + least), static_cast<std::int32_t>(base + most)});
        }
        begin = stop;
    }
}

} // namespace dynascope
