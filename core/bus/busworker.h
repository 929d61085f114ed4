// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/outbox.h"
#include "core/bus/poller.h"
#include "core/bus/stopsequence.h"

#include <QThread>

namespace dynascope {

/// The thread behind a BusThread: opens the line, runs jobs, polls in between, and STOP before everything. A QThread,
/// because QSerialPort wants one. Its members belong to run(), but for those marked.
class BusWorker final : public QThread
{
public:
    BusWorker(BusThread &owner, LineFactory &factory, Outbox &outbox, int baudRate);
    ~BusWorker() override;

    /// @name Any thread
    /// @{
    JobQueue &queue() { return m_queue; }
    int workingBaud() const { return m_workingBaud; }
    void setWorkingBaud(int bitsPerSecond);
    void setPollPlan(PollPlan plan);
    void setStopPlan(StopPlan plan);
    void requestStop();
    void requestClose();
    /// @}

    /// Delivers an error for a job that won't run.
    void refuse(const QueuedJob &job, const Error &error);

protected:
    void run() override;

private:
    class Context;

    void loop();
    void runJob(QueuedJob job);
    void runOrders();
    void poll();
    void idle();
    void runStop();
    void toWorkingBaud();
    void tellState(BusThread::State state, const Error &error = {});
    void tellStatistics(bool now);
    void tellQuality(bool now);
    void end(BusThread::State state, const Error &error);

    BusThread &m_owner; ///< touched by deliveries only, on its thread
    LineFactory &m_factory;
    Outbox &m_outbox;
    const QString m_name;
    JobQueue m_queue;
    std::atomic<int> m_workingBaud;
    std::atomic<bool> m_stopRequested{false}; ///< what the Bus looks at
    std::atomic<bool> m_closing{false};

    std::unique_ptr<Line> m_line;
    std::unique_ptr<Bus> m_bus;
    std::unique_ptr<Poller> m_poller;
    StopPlan m_stopPlan;
    int m_exclusive = 0;
    LineTime m_lookedAt{}; ///< when the idle port was last looked at
    LineTime m_toldAt{};   ///< when statistics were last told
    std::chrono::steady_clock::time_point m_qualityToldAt; ///< a person's time, whatever the line's clock does
};

} // namespace dynascope
