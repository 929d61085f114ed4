// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history/packedtimes.h"

#include <array>
#include <memory>
#include <numeric>
#include <utility>

namespace dynascope {

/// How much of a stretch of history is left.
enum class Detail { Samples, Fine, Coarse, Whole };

/// What all histories of one program hold, counted where it is taken and given back, and the times that several of them
/// share. Outlives them. Any one thread.
class HistoryMemory
{
public:
    static constexpr std::size_t Overhead = 16; ///< bytes, of each block that the heap hands out

    std::size_t used() const { return std::accumulate(m_used.begin(), m_used.end(), std::size_t(0)); } ///< bytes
    std::size_t used(Detail detail) const { return m_used[static_cast<std::size_t>(detail)]; }

    /// Fields that one reply brought have the same times: these ones packed, or the very same that another history has
    /// packed before.
    std::shared_ptr<const PackedTimes> pack(std::span<const LineTime> times);

private:
    friend class MemoryCharge;
    static constexpr std::size_t Kept = 64;

    std::array<std::size_t, 4> m_used{};
    std::array<std::weak_ptr<const PackedTimes>, Kept> m_recent;
    std::size_t m_next = 0;
};

/// Some bytes of it, given back with this.
class MemoryCharge
{
public:
    MemoryCharge() = default;
    MemoryCharge(HistoryMemory *memory, Detail detail, std::size_t bytes)
        : m_memory(memory), m_detail(detail), m_bytes(bytes)
    {
        if (m_memory)
            m_memory->m_used[static_cast<std::size_t>(m_detail)] += m_bytes;
    }
    MemoryCharge(MemoryCharge &&other) noexcept
        : m_memory(std::exchange(other.m_memory, nullptr)), m_detail(other.m_detail), m_bytes(other.m_bytes)
    {
    }
    MemoryCharge &operator=(MemoryCharge &&other) noexcept
    {
        std::swap(m_memory, other.m_memory);
        std::swap(m_detail, other.m_detail);
        std::swap(m_bytes, other.m_bytes);
        return *this;
    }
    ~MemoryCharge()
    {
        if (m_memory)
            m_memory->m_used[static_cast<std::size_t>(m_detail)] -= m_bytes;
    }

private:
    HistoryMemory *m_memory = nullptr;
    Detail m_detail = Detail::Samples;
    std::size_t m_bytes = 0;
};

} // namespace dynascope
