// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <cstdint>
#include <memory>
#include <span>

namespace dynascope {

/// Ascending times, exact to the nanosecond, in few bits each: a straight line through each 64 of them, and how far each
/// is from it. O(1) to read any.
class PackedTimes
{
public:
    PackedTimes() = default;
    explicit PackedTimes(std::span<const LineTime> times); ///< 4096 at most

    std::size_t size() const { return m_size; }
    LineTime operator[](std::size_t index) const;
    LineTime back() const { return (*this)[m_size - 1]; }
    /// The first that isn't before `at`; size() where there is none.
    std::size_t lowerBound(LineTime at) const;
    bool operator==(std::span<const LineTime> times) const;
    std::size_t heapBytes() const { return m_heapBytes; } ///< what was allocated, the heap's own not included

private:
    static constexpr std::size_t BlockSize = 64;

    // All arithmetic is modulo 2^64, so that no distance overflows.
    struct Block {
        std::uint64_t base;   ///< of the line, moved down to the lowest
        std::uint32_t step;   ///< ns
        std::uint16_t offset; ///< of its bits, in 8 bytes: 64 numbers of n bits are n of those
        std::uint16_t width;  ///< bits a number
    };

    std::unique_ptr<Block[]> m_blocks;
    std::unique_ptr<std::byte[]> m_bits;
    std::size_t m_size = 0;
    std::size_t m_heapBytes = 0;
};

} // namespace dynascope
