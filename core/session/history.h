// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>

namespace dynascope {

/// The raw values one field had (signed where a bit of it is the direction), with a pyramid of minima and maxima so that
/// any stretch can be drawn in as many columns as the screen has. Append-only; the oldest go when it is full. Any one
/// thread.
class History
{
public:
    struct Sample {
        LineTime at{};
        std::int32_t raw = 0;

        friend bool operator==(const Sample &, const Sample &) = default;
    };
    /// What falls into one pixel column.
    struct Column {
        std::int32_t minimum = 0, maximum = 0;
        std::int32_t first = 0, last = 0;
        bool isEmpty = true;
        bool gapBefore = false; ///< nothing was known for a while before this column: don't draw a line to it

        friend bool operator==(const Column &, const Column &) = default;
    };

    explicit History(std::size_t capacity = DefaultCapacity);

    void append(LineTime at, std::int32_t raw); ///< `at` not before the last one; an earlier one is dropped
    void appendGap(LineTime at);                ///< the value was asked for and did not come

    std::size_t size() const { return static_cast<std::size_t>(m_end - m_begin); }
    bool isEmpty() const { return m_end == m_begin; }
    Sample at(std::size_t index) const; ///< 0 is the oldest
    Sample last() const { return at(size() - 1); }
    bool gapBefore(std::size_t index) const; ///< nothing was known between this sample and the one before
    /// How many there ever were, those that had to go included: tells cheaply whether something new has come.
    std::uint64_t appended() const { return m_end; }

    /// Splits [from, to) into `columns.size()` equal columns and fills them. O(columns · log n).
    void columns(LineTime from, LineTime to, std::span<Column> columns) const;
    /// Smallest and largest raw value in [from, to), the samples just outside included where a line to them shows.
    bool range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const;
    /// Index of the first sample at or after `at`; size() where there is none.
    std::size_t indexAt(LineTime at) const;

    static constexpr std::size_t DefaultCapacity = 2'000'000;

private:
    // Samples lie in chunks that are never moved, so appending costs the same at any size. Positions count all samples
    // ever appended; blocks of the pyramid are aligned to them and stay where they are when old samples go.
    using Position = std::uint64_t;
    static constexpr std::size_t Fan = 16;
    static constexpr std::size_t FineSize = Fan;
    static constexpr std::size_t CoarseSize = Fan * Fan;
    static constexpr std::size_t ChunkSize = Fan * Fan * Fan;

    struct Extremes {
        std::int32_t minimum, maximum;
        void include(const Extremes &other)
        {
            minimum = other.minimum < minimum ? other.minimum : minimum;
            maximum = other.maximum > maximum ? other.maximum : maximum;
        }
    };
    struct Chunk {
        std::array<LineTime, ChunkSize> at;
        std::array<std::int32_t, ChunkSize> raw;
        std::array<Extremes, ChunkSize / FineSize> fine;
        std::array<Extremes, ChunkSize / CoarseSize> coarse;
        Extremes all;
        std::bitset<ChunkSize> gaps; ///< bit set: gap before this sample

        Extremes extremes(std::size_t from, std::size_t to) const;
    };

    const Chunk &chunkOf(Position position) const
    {
        return *m_chunks[static_cast<std::size_t>(position / ChunkSize - m_firstChunk)];
    }
    LineTime timeOf(Position position) const { return chunkOf(position).at[position % ChunkSize]; }
    std::int32_t rawOf(Position position) const { return chunkOf(position).raw[position % ChunkSize]; }
    bool hasGap(Position position) const { return chunkOf(position).gaps[position % ChunkSize]; }
    Position find(LineTime at) const;
    Position findNear(LineTime at, Position from, Position guess) const;
    Extremes extremes(Position from, Position to) const;
    void addChunk();

    std::size_t m_capacity;
    std::deque<std::unique_ptr<Chunk>> m_chunks; ///< the first one holds m_begin
    std::unique_ptr<Chunk> m_spare;              ///< the last one that was emptied, to be filled again
    Position m_begin = 0;
    Position m_end = 0;
    Position m_firstChunk = 0; ///< m_begin / ChunkSize
    bool m_gapPending = false;
};

} // namespace dynascope
