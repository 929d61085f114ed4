// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"
#include "core/bus/poll_values.h"
#include "core/bus/stop_values.h"

#include <QObject>
#include <QPointer>

#include <functional>
#include <memory>

namespace dynascope {

enum class Priority { Scan, Normal, Click }; ///< a waiting job of higher priority runs at the next checkpoint

/// What a job may use. Bus thread, only while the job runs.
class JobContext
{
public:
    virtual ~JobContext() = default;

    virtual Bus &bus() = 0;

    /// Between exchanges: lets waiting jobs of higher priority run, puts this job's baud rate back, and says whether to go
    /// on: Cancelled, Stopped, PortLost.
    virtual Result<void> checkpoint() = 0;

    /// Runs `note` on the GUI thread if the job's context object still lives there. For progress.
    virtual void post(std::function<void()> note) = 0;

    /// While one is held, only STOP gets in: between the first and last write of an ID or baud change.
    class Exclusive
    {
    public:
        explicit Exclusive(JobContext &context) : m_context(context) { m_context.enterExclusive(); }
        ~Exclusive() { m_context.leaveExclusive(); }
        Exclusive(const Exclusive &) = delete;
        Exclusive &operator=(const Exclusive &) = delete;

    private:
        JobContext &m_context;
    };

protected:
    virtual void enterExclusive() = 0;
    virtual void leaveExclusive() = 0;
};

using JobId = quint64;

/// An open line's thread: owns Line, Bus and Poller, runs jobs, polls in between. Lives on the GUI thread; its signals
/// come there. Closing waits for the exchange in flight only.
class BusThread : public QObject
{
    Q_OBJECT

public:
    enum class State { Opening, Open, Lost, Closed };

    /// Opens the line on its new thread; stateChanged() tells how that went. `factory` outlives this.
    BusThread(LineFactory &factory, QString name, int baudRate, QObject *parent = nullptr);
    ~BusThread() override;

    QString name() const;
    State state() const;
    Error error() const;    ///< why Lost or Closed
    int baudRate() const;   ///< the working baud rate

    /// Queues `job` for the bus thread and delivers its value to `done` on the GUI thread, unless `context` has died by
    /// then. Exactly one delivery: the value, the job's error, Cancelled, Stopped or PortLost.
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
    void cancel(JobId job); ///< waiting or running; it reports Cancelled at its next checkpoint

    /// Replaces what is polled when no job runs. Polling pauses while the line works at another baud rate for a job.
    void setPollPlan(PollPlan plan);
    /// Moves the line itself: later jobs and polls run at this rate. For jobs that change a device's baud, too.
    void setWorkingBaudRate(int bitsPerSecond);

    std::vector<Batch> takeBatches(); ///< those since the last call, oldest first; bounded, the oldest go first
    BusStatistics statistics() const; ///< as of the last batch or job

    /// @name STOP
    /// @{
    void setStopTargets(std::vector<StopTarget> targets); ///< those packets are made now
    void stop();                                          ///< returns at once
    bool isStopped() const;
    void release();                                       ///< a person did
    /// @}

signals:
    void stateChanged();
    void batchesReady(); ///< one pending notice at most
    void statisticsChanged();
    void stopFinished(const std::vector<dynascope::StopOutcome> &outcomes);

private:
    /// With a context: run, and return the delivery. Without: the delivery of `refusal`.
    using Job = std::function<std::function<void()>(JobContext *, const Error &refusal)>;
    JobId enqueue(Priority priority, QObject *context, Job job);

    class Worker;
    std::unique_ptr<Worker> m_worker;
};

} // namespace dynascope
