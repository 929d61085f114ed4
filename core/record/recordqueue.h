// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recorder.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <variant>
#include <vector>

namespace dynascope {

/// What the recorder's writer has still to do, and how far it is. Its mutex guards these and nothing else. Any thread.
class RecordQueue
{
public:
    using Item = std::variant<RecordedBatch, RecordedEvent, RecordedDevice>;
    static constexpr std::size_t Capacity = 64 << 20; ///< bytes, about: minutes at full rate

    /// False where it is closed, or full and `item` a batch: nothing was taken then, and `samples` count as lost.
    bool push(Item item, std::size_t samples);
    void close();

    /// All that waits, once there is something, it was closed, or the time is over.
    std::vector<Item> take(std::chrono::steady_clock::time_point deadline, bool &closed);

    /// Samples that were lost since this was last asked: to be said in the recording.
    quint64 takeLost();

    RecorderStatus status() const;
    void setStatus(const RecorderStatus &status); ///< `lost` is the queue's own
    void addLost(quint64 samples);

private:
    mutable std::mutex m_mutex;
    std::condition_variable m_changed;
    std::vector<Item> m_items;
    std::size_t m_bytes = 0;
    quint64 m_lost = 0;     ///< in all
    quint64 m_lostTold = 0; ///< of these
    RecorderStatus m_status;
    bool m_closed = false;
};

} // namespace dynascope
