// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history/packedtimes.h"

#include "core/session/history/bits.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace dynascope {
namespace {

std::uint64_t count(LineTime time)
{
    return static_cast<std::uint64_t>(time.count());
}

} // namespace

PackedTimes::PackedTimes(std::span<const LineTime> times)
    : m_blocks(std::make_unique<Block[]>((times.size() + BlockSize - 1) / BlockSize))
    , m_size(times.size())
{
    const std::size_t blocks = (times.size() + BlockSize - 1) / BlockSize;
    std::size_t words = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        const auto block = times.subspan(i * BlockSize, std::min(BlockSize, times.size() - i * BlockSize));
        const std::uint64_t length = count(block.back()) - count(block.front());
        std::uint64_t step = block.size() > 1 ? length / (block.size() - 1) : 0;
        if (step > std::numeric_limits<std::uint32_t>::max())
            step = 0; // seconds between two: the line would gain nothing
        // No distance from the line is longer than the block, so below 2^63 it has a sign; above there is no line.
        std::int64_t lowest = 0;
        std::int64_t highest = 0;
        for (std::size_t k = 0; step > 0 && k < block.size(); ++k) {
            const auto off = static_cast<std::int64_t>(count(block[k]) - count(block.front()) - k * step);
            lowest = std::min(lowest, off);
            highest = std::max(highest, off);
        }
        const std::uint64_t room = step > 0 ? static_cast<std::uint64_t>(highest - lowest) : length;
        auto width = static_cast<unsigned>(std::bit_width(room));
        if (width > bits::Widest)
            width = 64;
        m_blocks[i] = {count(block.front()) + static_cast<std::uint64_t>(lowest), static_cast<std::uint32_t>(step),
            static_cast<std::uint16_t>(words), static_cast<std::uint16_t>(width)};
        words += width;
    }
    m_heapBytes = blocks * sizeof(Block) + words * 8 + bits::Spare;
    m_bits = std::make_unique<std::byte[]>(words * 8 + bits::Spare);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Block &block = m_blocks[k / BlockSize];
        const std::size_t place = k % BlockSize;
        bits::write(m_bits.get(), block.offset * std::size_t(64) + place * block.width,
            count(times[k]) - block.base - place * block.step);
    }
}

LineTime PackedTimes::operator[](std::size_t index) const
{
    const Block &block = m_blocks[index / BlockSize];
    const std::size_t place = index % BlockSize;
    const std::uint64_t off =
        bits::read(m_bits.get(), block.offset * std::size_t(64) + place * block.width, bits::mask(block.width));
    return LineTime(static_cast<LineTime::rep>(block.base + place * block.step + off));
}

std::size_t PackedTimes::lowerBound(LineTime at) const
{
    std::size_t low = 0;
    std::size_t high = m_size;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if ((*this)[middle] < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool PackedTimes::operator==(std::span<const LineTime> times) const
{
    if (times.size() != m_size || m_size == 0 || (*this)[0] != times[0] || back() != times.back())
        return false;
    for (std::size_t i = 0; i < m_size; ++i) {
        if ((*this)[i] != times[i])
            return false;
    }
    return true;
}

} // namespace dynascope
