// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/packedchunk.h"

#include <deque>
#include <optional>

namespace dynascope {

/// What is left of samples that were folded away: extremes of blocks of 16, further back of 256, of 4096. When they
/// were is known as exactly as their block is long. Gaps stay, of many in one chunk the 16 longest.
class FoldedHistory
{
public:
    struct Stretch {
        Extremes extremes; ///< empty: nothing was there
        bool gapBefore = false;
    };

    bool isEmpty() const { return m_chunks.empty(); }
    LineTime first() const { return m_chunks.front().first; } ///< time of the first sample of which something is left
    LineTime last() const { return m_last; }                  ///< of the last

    void add(PackedChunk chunk, HistoryMemory *memory); ///< behind the last one
    /// When the oldest chunk begins of which so much is left; nothing where there is none.
    std::optional<LineTime> oldest(Detail detail) const;
    void foldOldest(Detail detail, HistoryMemory *memory); ///< leaves less of it, at last nothing

    /// Of all blocks that reach into [from, to). The last one is taken to reach up to `end`. O(log n), and one step for
    /// each whole chunk.
    Stretch stretch(LineTime from, LineTime to, LineTime end) const;

private:
    // A place is a slot counted through all chunks ever added; blocks are named by the place of their first sample.
    using Place = std::uint64_t;
    struct Blocks {
        std::size_t size; ///< samples a block
        PackedTimes starts;
        PackedExtremes fine;
        PackedExtremes coarse;

        void includeSamples(Extremes &, std::size_t, std::size_t) const {} // ends of blocks only
        void includeFine(Extremes &result, std::size_t begin, std::size_t end) const;
        void includeCoarse(Extremes &result, std::size_t begin, std::size_t end) const;
    };
    struct Chunk {
        Extremes all;
        LineTime first;
        std::unique_ptr<Blocks> blocks; ///< none: the whole is one
        std::uint16_t gaps = 0;         ///< of m_gaps
        MemoryCharge charge;
    };
    struct Gap {
        LineTime before, after; ///< times of the samples beside it
        Place place;            ///< of the one after it
    };

    Place endPlace() const { return (m_dropped + m_chunks.size()) * ChunkSize; }
    const Chunk &chunkOf(Place place) const { return m_chunks[static_cast<std::size_t>(place / ChunkSize - m_dropped)]; }
    std::size_t blockSize(Place place) const;
    std::size_t indexOf(Detail detail) const;
    std::size_t count(Detail detail) const;
    std::uint16_t addGaps(const PackedChunk &chunk);
    Place firstBlock(LineTime at) const;
    Extremes extremes(Place from, Place to) const;
    static void charge(Chunk &chunk, HistoryMemory *memory);

    std::deque<Chunk> m_chunks; ///< the coarsest first
    std::size_t m_whole = 0;    ///< how many of them are of that kind
    std::size_t m_coarse = 0;
    std::uint64_t m_dropped = 0; ///< chunks
    std::deque<Gap> m_gaps;
    LineTime m_last{};
};

} // namespace dynascope
