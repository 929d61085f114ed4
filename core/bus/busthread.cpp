// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/busthread.h"

#include "core/bus/busworker.h"
#include "core/bus/messages.h"

#include <utility>

namespace dynascope {

BusThread::BusThread(LineFactory &factory, QString name, int baudRate, QObject *parent)
    : QObject(parent)
    , m_name(std::move(name))
    , m_outbox(std::make_unique<Outbox>())
    , m_worker(std::make_unique<BusWorker>(*this, factory, *m_outbox, baudRate))
{
    connect(m_outbox.get(), &Outbox::batchesReady, this, &BusThread::batchesReady);
    connect(m_outbox.get(), &Outbox::statisticsChanged, this, &BusThread::statisticsChanged);
    connect(m_outbox.get(), &Outbox::qualityChanged, this, &BusThread::qualityChanged);
    m_worker->start();
}

BusThread::~BusThread() = default;

void BusThread::close()
{
    m_worker->requestClose();
    m_worker->wait();
    m_outbox->drain();
}

int BusThread::baudRate() const
{
    return m_worker->workingBaud();
}

JobId BusThread::enqueue(Priority priority, QObject *context, ErasedJob job)
{
    QueuedJob queued;
    const JobId id = queued.id = ++m_lastJob;
    queued.priority = priority;
    queued.recipient = std::make_shared<const Recipient>(context);
    queued.job = std::move(job);
    if (!m_worker->queue().push(queued)) {
        // The worker has ended; its last word, why, may still be in the outbox, before this.
        const QPointer<BusThread> self(this);
        auto refused = std::make_shared<QueuedJob>(std::move(queued));
        m_outbox->deliver(refused->recipient, [self, refused] {
            if (self)
                refused->job(nullptr, self->error())();
        });
    }
    return id;
}

void BusThread::cancel(JobId job)
{
    if (std::optional<QueuedJob> waiting = m_worker->queue().cancel(job))
        m_worker->refuse(*waiting, messages::cancelled());
}

void BusThread::setPollPlan(PollPlan plan)
{
    m_worker->setPollPlan(std::move(plan));
}

void BusThread::setWorkingBaudRate(int bitsPerSecond)
{
    m_worker->setWorkingBaud(bitsPerSecond);
}

std::vector<Batch> BusThread::takeBatches()
{
    return m_outbox->takeBatches();
}

BusStatistics BusThread::statistics() const
{
    return m_outbox->statistics();
}

LineQuality BusThread::quality() const
{
    return m_outbox->quality();
}

void BusThread::setStopTargets(std::vector<StopTarget> targets)
{
    m_stopTargets = targets;
    m_worker->setStopPlan(StopPlan(std::move(targets)));
}

void BusThread::stop()
{
    m_stopped = m_stopPending = true;
    // Emptied first: once the flag is up the worker may be done with it before we get on, and must find nothing to run.
    const auto waiting = m_worker->queue().takeAll();
    m_worker->requestStop();
    for (const QueuedJob &job : waiting)
        m_worker->refuse(job, messages::cancelled());
    if (m_state == State::Lost || m_state == State::Closed)
        m_outbox->deliverAlways([this] { failStop(); });
}

void BusThread::setState(State state, const Error &error)
{
    m_state = state;
    m_error = error;
    const QPointer<BusThread> self(this);
    emit stateChanged();
    if (self && (state == State::Lost || state == State::Closed))
        failStop();
}

/// Nobody is there any more who could send anything.
void BusThread::failStop()
{
    std::vector<StopOutcome> outcomes;
    for (const StopTarget &target : m_stopTargets)
        outcomes.push_back({target.device, false, m_error.text});
    finishStop(outcomes);
}

void BusThread::finishStop(const std::vector<StopOutcome> &outcomes)
{
    if (!std::exchange(m_stopPending, false))
        return;
    emit stopFinished(outcomes);
}

} // namespace dynascope
