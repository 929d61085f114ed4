// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/extremes.h"

#include "core/bus/line.h"

#include <array>
#include <bit>
#include <bitset>
#include <vector>

namespace dynascope {

/// The newest up to 4096 samples, as they came. Takes room as they come: a short history is a small one.
struct OpenChunk {
    std::vector<LineTime> at;
    std::vector<std::int32_t> raw;
    std::array<Extremes, ChunkSize / FineSize> fine;
    std::array<Extremes, ChunkSize / CoarseSize> coarse;
    Extremes all;
    std::bitset<ChunkSize> gaps; ///< bit set: gap before this sample

    static constexpr std::size_t FirstRoom = 256; ///< samples

    std::size_t bytes() const { return sizeof(OpenChunk) + at.size() * (sizeof(LineTime) + sizeof(std::int32_t)); }
    /// True: it takes more memory now.
    bool makeRoom(std::size_t slot)
    {
        if (slot < at.size())
            return false;
        const std::size_t room = std::max(FirstRoom, std::bit_ceil(slot + 1));
        std::vector<LineTime> times(room);
        std::vector<std::int32_t> values(room);
        std::ranges::copy(at, times.begin());
        std::ranges::copy(raw, values.begin());
        at = std::move(times); // no more than that: a vector that grows by itself may take a half more
        raw = std::move(values);
        return true;
    }

    void giveRoomBack()
    {
        at.clear();
        raw.clear();
    }

    /// Where there is room.
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
