// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/extremes.h"

#include "core/bus/line.h"

#include <array>
#include <bitset>

namespace dynascope {

/// The newest up to 4096 samples, as they came.
struct OpenChunk {
    std::array<LineTime, ChunkSize> at;
    std::array<std::int32_t, ChunkSize> raw;
    std::array<Extremes, ChunkSize / FineSize> fine;
    std::array<Extremes, ChunkSize / CoarseSize> coarse;
    Extremes all;
    std::bitset<ChunkSize> gaps; ///< bit set: gap before this sample

    void put(std::size_t slot, LineTime time, std::int32_t value, bool gap)
    {
        const auto include = [slot, value](Extremes &block, std::size_t blockSize) {
            if (slot % blockSize == 0)
                block = {};
            block.include(value);
        };
        at[slot] = time;
        raw[slot] = value;
        include(fine[slot / FineSize], FineSize);
        include(coarse[slot / CoarseSize], CoarseSize);
        include(all, ChunkSize);
        gaps.set(slot, gap);
    }
    Extremes extremes(std::size_t from, std::size_t to) const { return extremesOf(*this, from, to); }

    void includeSamples(Extremes &result, std::size_t begin, std::size_t end) const
    {
        for (; begin < end; ++begin)
            result.include(raw[begin]);
    }
    void includeFine(Extremes &result, std::size_t begin, std::size_t end) const
    {
        for (; begin < end; ++begin)
            result.include(fine[begin]);
    }
    void includeCoarse(Extremes &result, std::size_t begin, std::size_t end) const
    {
        for (; begin < end; ++begin)
            result.include(coarse[begin]);
    }
};

} // namespace dynascope
