// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace dynascope {

/// Smallest and largest of some raw values; of none, nothing is smaller.
struct Extremes {
    std::int32_t minimum = std::numeric_limits<std::int32_t>::max();
    std::int32_t maximum = std::numeric_limits<std::int32_t>::min();

    bool isEmpty() const { return minimum > maximum; }
    void include(const Extremes &other)
    {
        minimum = std::min(minimum, other.minimum);
        maximum = std::max(maximum, other.maximum);
    }
    void include(std::int32_t raw) { include({raw, raw}); }
    bool covers(const Extremes &other) const { return minimum <= other.minimum && maximum >= other.maximum; }
    std::uint32_t span() const { return static_cast<std::uint32_t>(maximum) - static_cast<std::uint32_t>(minimum); }

    friend bool operator==(const Extremes &, const Extremes &) = default;
};

// The pyramid: blocks of 16 samples, of 256, chunks of 4096.
constexpr std::size_t Fan = 16;
constexpr std::size_t FineSize = Fan;
constexpr std::size_t CoarseSize = Fan * Fan;
constexpr std::size_t ChunkSize = Fan * Fan * Fan;

/// Extremes of blocks in 0, 1, 2 or 4 bytes for each end, as their whole range needs.
class PackedExtremes
{
public:
    PackedExtremes() = default;
    explicit PackedExtremes(std::span<const Extremes> blocks);

    Extremes operator[](std::size_t index) const;
    void include(Extremes &result, std::size_t begin, std::size_t end) const; ///< blocks [begin, end)
    std::size_t heapBytes() const { return 2 * m_size * m_width; }

private:
    std::unique_ptr<std::byte[]> m_ends; ///< all minima, then all maxima, above m_base
    std::uint32_t m_base = 0;
    std::uint16_t m_size = 0;
    std::uint16_t m_width = 0; ///< bytes
};

/// Of the samples [from, to) of a chunk, at least one: whole blocks first, finer at both ends.
template <class Chunk>
Extremes extremesOf(const Chunk &chunk, std::size_t from, std::size_t to)
{
    Extremes result;
    const std::size_t fineBegin = (from + FineSize - 1) / FineSize;
    const std::size_t fineEnd = to / FineSize;
    if (fineBegin >= fineEnd) {
        chunk.includeSamples(result, from, to);
        return result;
    }
    const std::size_t coarseBegin = (fineBegin + Fan - 1) / Fan;
    const std::size_t coarseEnd = fineEnd / Fan;
    if (coarseBegin < coarseEnd) {
        chunk.includeFine(result, fineBegin, coarseBegin * Fan);
        chunk.includeFine(result, coarseEnd * Fan, fineEnd);
        chunk.includeCoarse(result, coarseBegin, coarseEnd);
    } else {
        chunk.includeFine(result, fineBegin, fineEnd);
    }
    chunk.includeSamples(result, from, fineBegin * FineSize);
    chunk.includeSamples(result, fineEnd * FineSize, to);
    return result;
}

} // namespace dynascope
