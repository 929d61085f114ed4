// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/jobcontext.h"
#include "core/bus/linefactory.h"
#include "core/bus/poll_values.h"
#include "core/bus/stop_values.h"

#include <QObject>
#include <QPointer>

#include <memory>

namespace dynascope {

class BusWorker;
class Outbox;

/// An open line's thread: owns Line, Bus and Poller, runs jobs, polls in between. Lives on the GUI thread; its signals
/// come there.
class BusThread : public QObject
{
    Q_OBJECT

public:
    enum class State { Opening, Open, Lost, Closed };

    /// Opens the line on its new thread; stateChanged() tells how that went. `factory` outlives this.
    BusThread(LineFactory &factory, QString name, int baudRate, QObject *parent = nullptr);
    /// Delivers nothing any more: close() first where a job's end matters.
    ~BusThread() override;

    /// Ends what runs as soon as the packet in flight has left, even in an exclusive scope, closes the line and
    /// delivers Cancelled for what was running or queued, before it returns. Only STOP's packets still go out,
    /// unverified.
    void close();

    QString name() const { return m_name; }
    State state() const { return m_state; }
    Error error() const { return m_error; } ///< why Lost or Closed
    int baudRate() const;                   ///< the working baud rate

    /// Queues `job` for the bus thread and delivers its value to `done` on the GUI thread, unless `context` has died by
    /// then (a null context never does). Exactly one delivery: the value, the job's error, Cancelled, Stopped or
    /// PortLost.
    template <typename T>
    JobId run(Priority priority, QObject *context, std::function<Result<T>(JobContext &)> job,
        std::function<void(Result<T>)> done)
    {
        return enqueue(priority, context,
            [job = std::move(job), done = std::move(done)](JobContext *jobContext, const Error &refusal) {
                auto value = std::make_shared<Result<T>>(
                    jobContext ? job(*jobContext) : Result<T>(tl::unexpected<Error>(refusal)));
                return std::function<void()>([value, done] { done(std::move(*value)); });
            });
    }
    void cancel(JobId job); ///< waiting or running; it reports Cancelled at its next exchange or checkpoint

    /// Replaces what is polled when no job runs. Polling pauses while the line works at another baud rate for a job.
    void setPollPlan(PollPlan plan);
    /// Moves the line itself: later jobs and polls run at this rate. For jobs that change a device's baud, too.
    void setWorkingBaudRate(int bitsPerSecond);

    std::vector<Batch> takeBatches(); ///< those since the last call, oldest first; bounded, the oldest go first
    BusStatistics statistics() const; ///< as of the last batch or job
    LineQuality quality() const;      ///< since the line was opened, as it was about half a second ago

    /// @name STOP
    /// @{
    void setStopTargets(std::vector<StopTarget> targets); ///< those packets are made now
    void stop();                                          ///< returns at once
    bool isStopped() const { return m_stopped; }
    void release() { m_stopped = false; } ///< a person did
    /// @}

signals:
    void stateChanged();
    void batchesReady(); ///< one pending notice at most
    void statisticsChanged();
    void qualityChanged(); ///< about twice a second while the line is open, and when it ends
    void stopFinished(const std::vector<dynascope::StopOutcome> &outcomes);

private:
    JobId enqueue(Priority priority, QObject *context, ErasedJob job);

    friend class BusWorker;
    void setState(State state, const Error &error);
    void finishStop(const std::vector<StopOutcome> &outcomes);
    void failStop();

    QString m_name;
    State m_state = State::Opening;
    Error m_error;
    bool m_stopped = false;
    bool m_stopPending = false; ///< its outcome has not come yet
    JobId m_lastJob = 0;
    std::vector<StopTarget> m_stopTargets;
    std::unique_ptr<Outbox> m_outbox; ///< outlives the worker, which fills it
    std::unique_ptr<BusWorker> m_worker;
};

} // namespace dynascope
