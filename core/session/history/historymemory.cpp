// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/history/historymemory.h"

namespace dynascope {

namespace {

struct CountedTimes {
    PackedTimes times;
    MemoryCharge charge;
};

} // namespace

std::shared_ptr<const PackedTimes> HistoryMemory::pack(std::span<const LineTime> times)
{
    for (std::size_t i = 1; i <= Kept; ++i) { // the newest first: fields of one device come one behind the other
        const std::shared_ptr<const PackedTimes> other = m_recent[(m_next + Kept - i) % Kept].lock();
        if (other && *other == times)
            return other;
    }
    auto counted = std::make_shared<CountedTimes>();
    counted->times = PackedTimes(times);
    counted->charge = MemoryCharge(
        this, Detail::Samples, sizeof(CountedTimes) + counted->times.heapBytes() + 4 * Overhead);
    const std::shared_ptr<const PackedTimes> result(counted, &counted->times);
    m_recent[m_next] = result;
    m_next = (m_next + 1) % Kept;
    return result;
}

} // namespace dynascope
