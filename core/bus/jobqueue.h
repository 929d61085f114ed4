// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace dynascope {

/// The object a delivery is for. Made and looked at on the GUI thread only; carried by the bus thread.
struct Recipient {
    QPointer<QObject> object;
    bool always = false; ///< no object was given

    explicit Recipient(QObject *context) : object(context), always(context == nullptr) { }
    bool isThere() const { return always || object; }
};

struct QueuedJob {
    JobId id = 0;
    Priority priority = Priority::Normal;
    std::shared_ptr<const Recipient> recipient;
    ErasedJob job;
    std::shared_ptr<std::atomic<bool>> cancelled = std::make_shared<std::atomic<bool>>(false);
};

/// Work for the bus thread. The only way in; its mutex guards these lists and nothing else. Any thread.
class JobQueue
{
public:
    using Order = std::function<void()>;

    /// False once closed: then `job` is left as it was.
    bool push(QueuedJob &job);
    /// Something small that is no job: a new poll plan. Runs before the next job, poll or STOP; none is
    /// taken once closed.
    void pushOrder(Order order);

    /// The first of the highest priority, if that is above `above`.
    std::optional<QueuedJob> take(std::optional<Priority> above = {});
    std::vector<Order> takeOrders();

    /// The job, if it still waits; it is out of the queue then. A running one is told by its flag.
    std::optional<QueuedJob> cancel(JobId id);
    std::vector<QueuedJob> takeAll();
    std::vector<QueuedJob> close(); ///< what is still waiting; nothing is taken from now on

    void finished(JobId id); ///< a taken job has ended

    /// Until something was pushed, wake() was called, or the time is over.
    void wait(std::chrono::nanoseconds longest);
    void wake();

private:
    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::deque<QueuedJob> m_jobs;
    std::vector<Order> m_orders;
    std::vector<std::pair<JobId, std::shared_ptr<std::atomic<bool>>>> m_running;
    bool m_closed = false;
    bool m_awake = false;
};

} // namespace dynascope
