// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/jobqueue.h"

#include <algorithm>
#include <utility>

namespace dynascope {

bool JobQueue::push(QueuedJob &job)
{
    const std::lock_guard lock(m_mutex);
    if (m_closed)
        return false;
    m_jobs.push_back(std::move(job));
    m_awake = true;
    m_changed.notify_all();
    return true;
}

void JobQueue::pushOrder(Order order)
{
    const std::lock_guard lock(m_mutex);
    if (m_closed)
        return;
    m_orders.push_back(std::move(order));
    m_awake = true;
    m_changed.notify_all();
}

std::optional<QueuedJob> JobQueue::take(std::optional<Priority> above)
{
    const std::lock_guard lock(m_mutex);
    auto best = m_jobs.end();
    for (auto it = m_jobs.begin(); it != m_jobs.end(); ++it) {
        if ((!above || it->priority > *above) && (best == m_jobs.end() || it->priority > best->priority))
            best = it;
    }
    if (best == m_jobs.end())
        return std::nullopt;
    QueuedJob job = std::move(*best);
    m_jobs.erase(best);
    m_running.emplace_back(job.id, job.cancelled);
    return job;
}

std::vector<JobQueue::Order> JobQueue::takeOrders()
{
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_orders, {});
}

std::optional<QueuedJob> JobQueue::cancel(JobId id)
{
    const std::lock_guard lock(m_mutex);
    for (const auto &[running, flag] : m_running) {
        if (running == id)
            flag->store(true, std::memory_order_release);
    }
    const auto waiting = std::ranges::find(m_jobs, id, &QueuedJob::id);
    if (waiting == m_jobs.end())
        return std::nullopt;
    QueuedJob job = std::move(*waiting);
    m_jobs.erase(waiting);
    return job;
}

std::vector<QueuedJob> JobQueue::takeAll()
{
    const std::lock_guard lock(m_mutex);
    std::vector<QueuedJob> jobs(std::make_move_iterator(m_jobs.begin()), std::make_move_iterator(m_jobs.end()));
    m_jobs.clear();
    return jobs;
}

std::vector<QueuedJob> JobQueue::close()
{
    std::vector<QueuedJob> jobs = takeAll();
    const std::lock_guard lock(m_mutex);
    m_closed = true;
    // Between the two locks another may have come.
    jobs.insert(jobs.end(), std::make_move_iterator(m_jobs.begin()), std::make_move_iterator(m_jobs.end()));
    m_jobs.clear();
    for (const auto &[running, flag] : m_running)
        flag->store(true, std::memory_order_release);
    m_awake = true;
    m_changed.notify_all();
    return jobs;
}

void JobQueue::finished(JobId id)
{
    const std::lock_guard lock(m_mutex);
    std::erase_if(m_running, [id](const auto &entry) { return entry.first == id; });
}

void JobQueue::wait(std::chrono::nanoseconds longest)
{
    std::unique_lock lock(m_mutex);
    m_changed.wait_for(lock, longest, [this] { return m_awake; });
    m_awake = false;
}

void JobQueue::wake()
{
    const std::lock_guard lock(m_mutex);
    m_awake = true;
    m_changed.notify_all();
}

} // namespace dynascope
