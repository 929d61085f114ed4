// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/historymemory.h"
#include "core/session/history/openchunk.h"

#include <vector>

namespace dynascope {

/// 4096 samples for good, nothing lost, each still found in O(1): values in as few bits as the block of 16 they stand in
/// needs, times shared with the fields that came in the same replies, gaps by their place.
class PackedChunk
{
public:
    PackedChunk(const OpenChunk &from, HistoryMemory *memory);

    LineTime at(std::size_t slot) const { return (*m_times)[slot]; }
    std::int32_t raw(std::size_t slot) const;
    bool hasGap(std::size_t slot) const { return !m_gaps.empty() && std::ranges::binary_search(m_gaps, slot); }
    Extremes extremes(std::size_t from, std::size_t to) const { return extremesOf(*this, from, to); }
    const Extremes &all() const { return m_all; }

    void includeSamples(Extremes &result, std::size_t begin, std::size_t end) const;
    void includeFine(Extremes &result, std::size_t begin, std::size_t end) const { m_fine.include(result, begin, end); }
    void includeCoarse(Extremes &result, std::size_t begin, std::size_t end) const
    {
        m_coarse.include(result, begin, end);
    }

    // What stays of it when it is folded.
    PackedExtremes takeFine() { return std::move(m_fine); }
    PackedExtremes takeCoarse() { return std::move(m_coarse); }
    std::span<const std::uint16_t> gaps() const { return m_gaps; }

private:
    /// Where the values of a block of 16 are.
    struct Block {
        std::size_t bit;
        unsigned width;
        std::int32_t base;
    };
    Block block(std::size_t fine, const Extremes &extremes) const;
    std::int32_t value(const Block &block, std::size_t place) const;
    void packValues(const OpenChunk &from);

    Extremes m_all;
    PackedExtremes m_fine;
    PackedExtremes m_coarse;
    std::unique_ptr<std::byte[]> m_values; ///< for each block two bytes where it begins, then the bits
    std::size_t m_valueBytes = 0;
    std::vector<std::uint16_t> m_gaps; ///< slots, ascending
    std::shared_ptr<const PackedTimes> m_times;
    MemoryCharge m_charge;
};

} // namespace dynascope
