// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dynascope {

/// The raw values one field had, with a pyramid of minima and maxima so that any stretch can be drawn in as many columns
/// as the screen has. Append-only; the oldest go when it is full. Any one thread.
class History
{
public:
    struct Sample {
        LineTime at{};
        std::int32_t raw = 0;
    };
    /// What falls into one pixel column.
    struct Column {
        std::int32_t minimum = 0, maximum = 0;
        std::int32_t first = 0, last = 0;
        bool isEmpty = true;
        bool gapBefore = false; ///< nothing was known for a while before this column: don't draw a line to it
    };

    explicit History(std::size_t capacity = DefaultCapacity);

    void append(LineTime at, std::int32_t raw); ///< `at` not before the last one; an earlier one is dropped
    void appendGap(LineTime at);                ///< the value was asked for and did not come

    std::size_t size() const;
    bool isEmpty() const { return size() == 0; }
    Sample at(std::size_t index) const; ///< 0 is the oldest
    Sample last() const;

    /// Splits [from, to) into `columns.size()` equal columns and fills them. O(columns · log n).
    void columns(LineTime from, LineTime to, std::span<Column> columns) const;
    /// Smallest and largest raw value in [from, to), the samples just outside included where a line to them shows.
    bool range(LineTime from, LineTime to, std::int32_t &minimum, std::int32_t &maximum) const;
    /// Index of the first sample at or after `at`; size() where there is none.
    std::size_t indexAt(LineTime at) const;

    static constexpr std::size_t DefaultCapacity = 2'000'000;

private:
    // The owner of this file chooses the representation.
    std::vector<Sample> m_samples;
};

} // namespace dynascope
