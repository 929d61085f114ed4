// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recordingsink.h"
#include "core/record/recordqueue.h"

#include <functional>

namespace dynascope {

/// The recorder's other side: takes from the queue, writes, and begins a new file where one is full. The writer's
/// thread, but for open().
class RecordWriter
{
public:
    using Failed = std::function<void(const Error &)>;

    /// `failed` is called on the writer's thread, once at most.
    RecordWriter(RecorderSettings settings, std::shared_ptr<RecordQueue> queue, Failed failed);

    Result<void> open(); ///< the first file; before the thread runs
    void run();          ///< until the queue is closed and empty

private:
    using Clock = std::chrono::steady_clock;

    void take(const RecordQueue::Item &item);
    void flush(bool isLast);
    Result<void> write(const RecordQueue::Item &item);
    Result<void> write(const RecordedBatch &batch);
    Result<void> setDevice(const RecordedDevice &device);
    Result<void> noteLost();
    Result<void> nextFile();
    void count(const RecordedBatch &batch, std::size_t &samples, std::size_t &missed) const;
    void fail(const Error &error);
    void tell();

    RecorderSettings m_settings; ///< its header's devices as they are now
    std::shared_ptr<RecordQueue> m_queue;
    Failed m_failed;
    std::unique_ptr<RecordingSink> m_sink;
    RecorderStatus m_status;
    std::size_t m_unflushed = 0; ///< samples that are not in the file yet
    qint64 m_finishedBytes = 0;         ///< of the files before this one
    std::optional<LineTime> m_fileBegin; ///< of the first batch in this file
    LineTime m_lastAt{};
    bool m_isDirty = false;
    Clock::time_point m_dirtySince;
};

} // namespace dynascope
