// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recordqueue.h"

#include <utility>

namespace dynascope {
namespace {

std::size_t sizeOf(const RecordQueue::Item &item)
{
    std::size_t size = sizeof(item);
    if (const auto *batch = std::get_if<RecordedBatch>(&item)) {
        for (const RecordedReply &reply : batch->replies)
            size += sizeof(reply) + reply.data.capacity();
    }
    return size;
}

} // namespace

bool RecordQueue::push(Item item, std::size_t samples)
{
    const std::size_t size = sizeOf(item);
    const bool isBatch = std::holds_alternative<RecordedBatch>(item);
    const std::lock_guard lock(m_mutex);
    if (m_closed || (isBatch && m_bytes + size > Capacity)) {
        m_lost += samples;
        return false;
    }
    m_bytes += size;
    m_items.push_back(std::move(item));
    m_changed.notify_one();
    return true;
}

void RecordQueue::close()
{
    const std::lock_guard lock(m_mutex);
    m_closed = true;
    m_changed.notify_one();
}

std::vector<RecordQueue::Item> RecordQueue::take(std::chrono::steady_clock::time_point deadline, bool &closed)
{
    std::unique_lock lock(m_mutex);
    m_changed.wait_until(lock, deadline, [this] { return m_closed || !m_items.empty(); });
    closed = m_closed;
    m_bytes = 0;
    return std::exchange(m_items, {});
}

quint64 RecordQueue::takeLost()
{
    const std::lock_guard lock(m_mutex);
    return m_lost - std::exchange(m_lostTold, m_lost);
}

RecorderStatus RecordQueue::status() const
{
    const std::lock_guard lock(m_mutex);
    RecorderStatus status = m_status;
    status.lost = m_lost;
    return status;
}

void RecordQueue::setStatus(const RecorderStatus &status)
{
    const std::lock_guard lock(m_mutex);
    m_status = status;
}

void RecordQueue::addLost(quint64 samples)
{
    const std::lock_guard lock(m_mutex);
    m_lost += samples;
}

} // namespace dynascope
