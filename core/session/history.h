// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/foldedhistory.h"

namespace dynascope {

/// The raw values one field had (signed where a bit of it is the direction), with a pyramid of minima and maxima so that
/// any stretch can be drawn in as many columns as the screen has. Append-only. Any one thread.
///
/// The newest samples lie as they came; behind them, in chunks of 4096, they are packed, and nothing of them is lost.
/// Where memory runs out (`Histories`), the oldest are folded: at(), indexAt(), gapBefore() and size() then know only the
/// samples that are left, index 0 being the oldest of those, while columns() and range() go on with the extremes of
/// blocks, of 16 samples at first, further back of 256 and 4096. Nothing between two pixels is lost by that, but it may
/// show as much too early or too late as its block is long.
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
        std::int32_t first = 0, last = 0; ///< where samples were folded: the way of least movement
        bool isEmpty = true;
        bool gapBefore = false; ///< nothing was known for a while before this column: don't draw a line to it

        friend bool operator==(const Column &, const Column &) = default;
    };

    explicit History(std::size_t capacity = DefaultCapacity); ///< samples; more than those go, and leave nothing
    /// Without a limit of its own. The first sample takes the place `slot` of its chunk: where fields that come in the
    /// same replies stand alike, they share their times.
    explicit History(HistoryMemory &memory, std::size_t slot = 0);

    void append(LineTime at, std::int32_t raw); ///< `at` not before the last one; an earlier one is dropped
    void appendGap(LineTime at);                ///< the value was asked for and did not come

    std::size_t size() const { return static_cast<std::size_t>(m_end - m_begin); }
    bool isEmpty() const { return m_end == m_begin; }
    Sample at(std::size_t index) const; ///< 0 is the oldest
    Sample last() const { return at(size() - 1); }
    bool gapBefore(std::size_t index) const; ///< nothing was known between this sample and the one before
    /// How many there ever were, those that had to go included: tells cheaply whether something new has come.
    std::uint64_t appended() const { return m_end - m_origin; }

    /// Splits [from, to) into `columns.size()` equal columns and fills them. O(columns · log n).
    void columns(LineTime from, LineTime to, std::span<Column> columns) const;
    /// Smallest and largest raw value in [from, to), the samples just outside included where a line to them shows.
    bool range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const;
    /// Index of the first sample at or after `at`; size() where there is none.
    std::size_t indexAt(LineTime at) const;

    /// Is something of [from, to) left that only columns() and range() know?
    bool isFolded(LineTime from, LineTime to) const;
    std::size_t slotFor(LineTime at) const; ///< of a sample that comes in the same reply as one of this history
    /// When the oldest begins of which so much is left; nothing where there is none that could be folded.
    std::optional<LineTime> oldest(Detail detail) const;
    void foldOldest(Detail detail); ///< leaves less of that

    static constexpr std::size_t DefaultCapacity = 2'000'000;

private:
    // Positions count all samples ever appended; blocks of the pyramid are aligned to them and stay where they are when
    // old samples go.
    using Position = std::uint64_t;
    class Reader;

    void openChunk();
    void dropOldest();
    void forgetOldestChunk();
    Position find(LineTime at) const;
    LineTime foldedEnd() const;
    void foldedColumns(LineTime from, LineTime to, std::span<Column> columns) const;

    std::size_t m_capacity;
    HistoryMemory *m_memory = nullptr;
    FoldedHistory m_folded;
    std::deque<PackedChunk> m_packed;
    std::vector<Extremes> m_whole; ///< of each packed chunk, side by side: an axis asks for all of them with each frame
    std::unique_ptr<OpenChunk> m_open; ///< behind those; what is full stays open until there is another sample
    MemoryCharge m_openCharge;
    Position m_origin = 0;
    Position m_begin = 0;
    Position m_end = 0;
    Position m_packedBegin = 0; ///< of the first packed chunk
    Position m_openBegin = 0;
    bool m_gapPending = false;
};

} // namespace dynascope
