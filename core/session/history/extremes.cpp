// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history/extremes.h"

#include <cstring>

namespace dynascope {
namespace {

template <class T>
T endAt(const std::byte *ends, std::size_t index)
{
    T end;
    std::memcpy(&end, ends + index * sizeof(T), sizeof(T));
    return end;
}

template <class T>
void put(std::byte *ends, std::size_t index, std::uint32_t value)
{
    const auto end = static_cast<T>(value);
    std::memcpy(ends + index * sizeof(T), &end, sizeof(T));
}

template <class T>
Extremes blockAt(const std::byte *ends, std::size_t size, std::uint32_t base, std::size_t index)
{
    return {static_cast<std::int32_t>(base + endAt<T>(ends, index)),
            static_cast<std::int32_t>(base + endAt<T>(ends, size + index))};
}

template <class T>
Extremes blocksIn(const std::byte *ends, std::size_t size, std::uint32_t base, std::size_t begin, std::size_t end)
{
    T lowest = std::numeric_limits<T>::max();
    T highest = 0;
    for (std::size_t i = begin; i < end; ++i) {
        lowest = std::min(lowest, endAt<T>(ends, i));
        highest = std::max(highest, endAt<T>(ends, size + i));
    }
    return {static_cast<std::int32_t>(base + lowest), static_cast<std::int32_t>(base + highest)};
}

} // namespace

PackedExtremes::PackedExtremes(std::span<const Extremes> blocks)
    : m_size(static_cast<std::uint16_t>(blocks.size()))
{
    Extremes all;
    for (const Extremes &block : blocks)
        all.include(block);
    m_base = static_cast<std::uint32_t>(all.minimum);
    m_width = all.span() == 0 ? 0 : all.span() <= 0xFF ? 1 : all.span() <= 0xFFFF ? 2 : 4;
    m_ends = m_width == 0 ? nullptr : std::make_unique<std::byte[]>(heapBytes());
    for (std::size_t i = 0; i < blocks.size() && m_width > 0; ++i) {
        const auto store = m_width == 1 ? put<std::uint8_t> : m_width == 2 ? put<std::uint16_t> : put<std::uint32_t>;
        store(m_ends.get(), i, static_cast<std::uint32_t>(blocks[i].minimum) - m_base);
        store(m_ends.get(), m_size + i, static_cast<std::uint32_t>(blocks[i].maximum) - m_base);
    }
}

Extremes PackedExtremes::operator[](std::size_t index) const
{
    switch (m_width) {
    case 0: return {static_cast<std::int32_t>(m_base), static_cast<std::int32_t>(m_base)};
    case 1: return blockAt<std::uint8_t>(m_ends.get(), m_size, m_base, index);
    case 2: return blockAt<std::uint16_t>(m_ends.get(), m_size, m_base, index);
    default: return blockAt<std::uint32_t>(m_ends.get(), m_size, m_base, index);
    }
}

void PackedExtremes::include(Extremes &result, std::size_t begin, std::size_t end) const
{
    if (begin >= end)
        return;
    switch (m_width) {
    case 0: result.include(static_cast<std::int32_t>(m_base)); break;
    case 1: result.include(blocksIn<std::uint8_t>(m_ends.get(), m_size, m_base, begin, end)); break;
    case 2: result.include(blocksIn<std::uint16_t>(m_ends.get(), m_size, m_base, begin, end)); break;
    default: result.include(blocksIn<std::uint32_t>(m_ends.get(), m_size, m_base, begin, end)); break;
    }
}

} // namespace dynascope
