// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/busworker.h"

#include "core/bus/messages.h"

#include <algorithm>
#include <utility>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime LookInterval = 100ms; ///< an unplugged port says so only when it is looked at
constexpr LineTime TellInterval = 250ms;
constexpr auto QualityInterval = 500ms; ///< a snapshot has a few hundred bytes a device

} // namespace

/// What a running job sees.
class BusWorker::Context final : public JobContext
{
public:
    Context(BusWorker &worker, const QueuedJob &job) : m_worker(worker), m_job(job) { }

    Bus &bus() override { return *m_worker.m_bus; }

    Result<void> checkpoint() override
    {
        for (;;) {
            if (Result<void> on = mayGoOn(); !on)
                return on;
            if (m_worker.m_exclusive > 0)
                return {};
            m_worker.tellQuality(false);
            std::optional<QueuedJob> urgent = m_worker.m_queue.take(m_job.priority);
            if (!urgent)
                return {};
            const int baudRate = bus().line().baudRate();
            m_worker.runJob(std::move(*urgent));
            bus().setCancel(m_job.cancelled.get());
            if (Result<void> back = bus().setBaudRate(baudRate); !back)
                return back;
        }
    }

    void post(std::function<void()> note) override { m_worker.m_outbox.deliver(m_job.recipient, std::move(note)); }

protected:
    void enterExclusive() override
    {
        ++m_worker.m_exclusive;
        bus().setCancel(&m_worker.m_closing);
    }
    void leaveExclusive() override
    {
        if (--m_worker.m_exclusive == 0)
            bus().setCancel(m_job.cancelled.get());
    }

private:
    Result<void> mayGoOn()
    {
        if (bus().lost())
            return tl::unexpected(*bus().lost());
        if (bus().isStopped())
            return tl::unexpected(messages::stopped());
        if (m_worker.m_closing)
            return tl::unexpected(messages::closed(m_worker.m_name));
        if (m_worker.m_exclusive > 0)
            return {};
        if (m_job.cancelled->load(std::memory_order_acquire))
            return tl::unexpected(messages::cancelled());
        return {};
    }

    BusWorker &m_worker;
    const QueuedJob &m_job;
};

BusWorker::BusWorker(BusThread &owner, LineFactory &factory, Outbox &outbox, int baudRate)
    : m_owner(owner), m_factory(factory), m_outbox(outbox), m_name(owner.name()), m_workingBaud(baudRate)
{
    setObjectName(QStringLiteral("bus ") + m_name);
}

BusWorker::~BusWorker()
{
    requestClose();
    wait();
}

void BusWorker::setWorkingBaud(int bitsPerSecond)
{
    m_workingBaud = bitsPerSecond;
    m_queue.wake();
}

void BusWorker::setPollPlan(PollPlan plan)
{
    m_queue.pushOrder([this, plan = std::move(plan)] { m_poller->setPlan(plan); });
}

void BusWorker::setStopPlan(StopPlan plan)
{
    m_queue.pushOrder([this, plan = std::move(plan)] { m_stopPlan = plan; });
}

void BusWorker::requestStop()
{
    m_stopRequested.store(true, std::memory_order_release);
    m_queue.wake();
}

void BusWorker::requestClose()
{
    m_closing = true;
    for (const QueuedJob &job : m_queue.close())
        refuse(job, messages::closed(m_name));
}

void BusWorker::refuse(const QueuedJob &job, const Error &error)
{
    m_outbox.deliver(job.recipient, job.job(nullptr, error));
}

void BusWorker::run()
{
    Result<std::unique_ptr<Line>> line = m_factory.openUnless(m_closing, m_name, m_workingBaud);
    if (!line) {
        end(BusThread::State::Closed, line.error());
        return;
    }
    m_line = std::move(*line);
    m_bus = std::make_unique<Bus>(*m_line, &m_stopRequested);
    m_bus->setCancel(&m_closing);
    m_poller = std::make_unique<Poller>(*m_bus);
    tellState(BusThread::State::Open);
    loop();
    const std::optional<Error> lost = m_bus->lost();
    tellStatistics(true);
    tellQuality(true);
    m_poller.reset();
    m_bus.reset();
    m_line.reset(); // the port is free before anybody hears of it
    if (lost)
        end(BusThread::State::Lost, *lost);
    else
        end(BusThread::State::Closed, messages::closed(m_name));
}

void BusWorker::loop()
{
    while (!m_bus->lost()) {
        runOrders();
        tellQuality(false);
        if (m_stopRequested.load(std::memory_order_acquire)) {
            runStop(); // also where somebody closes the line right after it
            continue;
        }
        if (m_closing)
            return;
        if (std::optional<QueuedJob> job = m_queue.take()) {
            runJob(std::move(*job));
            continue;
        }
        toWorkingBaud();
        if (!m_poller->isIdle() && m_poller->nextDue() <= m_line->now())
            poll();
        else
            idle();
    }
}

void BusWorker::runOrders()
{
    for (const JobQueue::Order &order : m_queue.takeOrders())
        order();
}

void BusWorker::runJob(QueuedJob job)
{
    toWorkingBaud();
    m_bus->setCancel(job.cancelled.get());
    Context context(*this, job);
    std::function<void()> delivery;
    if (job.cancelled->load(std::memory_order_acquire))
        delivery = job.job(nullptr, messages::cancelled());
    else if (m_bus->lost())
        delivery = job.job(nullptr, *m_bus->lost());
    else
        delivery = job.job(&context, {});
    m_bus->setCancel(&m_closing);
    m_queue.finished(job.id);
    tellStatistics(true);
    m_outbox.deliver(job.recipient, std::move(delivery));
}

void BusWorker::poll()
{
    Result<Batch> batch = m_poller->runCycle();
    if (!batch) // STOP, or the port: the loop sees which
        return;
    tellStatistics(false);
    if (!batch->values.empty())
        m_outbox.addBatch(std::move(*batch));
}

void BusWorker::idle()
{
    const LineTime now = m_line->now();
    if (now - m_lookedAt >= LookInterval) {
        m_lookedAt = now;
        m_bus->look();
    }
    LineTime longest = LookInterval;
    if (!m_poller->isIdle())
        longest = std::clamp<LineTime>(m_poller->nextDue() - now, LineTime(0), LookInterval);
    m_queue.wait(longest);
}

void BusWorker::runStop()
{
    runOrders(); // targets that were handed over just before it was pressed
    const Result<void> sent = sendTorqueOff(*m_bus, m_stopPlan, m_workingBaud);
    // From here on exchanges work again; pressed once more, STOP begins anew.
    m_stopRequested.store(false, std::memory_order_release);
    std::vector<StopOutcome> outcomes;
    if (sent) {
        outcomes = verifyTorqueOff(*m_bus, m_stopPlan, m_workingBaud);
        if (m_bus->isStopped() || m_bus->isCancelled())
            return;
    } else {
        for (const StopTarget &target : m_stopPlan.targets())
            outcomes.push_back({target.device, false, sent.error().text});
    }
    tellStatistics(true);
    m_outbox.deliverAlways([&owner = m_owner, outcomes] { owner.finishStop(outcomes); });
}

void BusWorker::toWorkingBaud()
{
    const int wanted = m_workingBaud;
    if (m_line->baudRate() == wanted || m_bus->setBaudRate(wanted) || m_bus->lost())
        return;
    // A rate that the port can't do: the line stays where it works, and says so.
    int expected = wanted;
    m_workingBaud.compare_exchange_strong(expected, m_line->baudRate());
    tellState(BusThread::State::Open);
}

void BusWorker::tellState(BusThread::State state, const Error &error)
{
    m_outbox.deliverAlways([&owner = m_owner, state, error] { owner.setState(state, error); });
}

void BusWorker::tellStatistics(bool now)
{
    const bool tell = now || m_line->now() - m_toldAt >= TellInterval;
    if (tell)
        m_toldAt = m_line->now();
    m_outbox.setStatistics(m_bus->statistics(), tell);
}

void BusWorker::tellQuality(bool now)
{
    const auto present = std::chrono::steady_clock::now();
    if (!now && present - m_qualityToldAt < QualityInterval)
        return;
    m_qualityToldAt = present;
    LineQuality quality = m_bus->quality();
    quality.at = m_line->now();
    quality.polled = m_poller->report();
    m_outbox.setQuality(std::move(quality));
}

/// The state first: whoever is refused can ask for it.
void BusWorker::end(BusThread::State state, const Error &error)
{
    tellState(state, error);
    for (const QueuedJob &job : m_queue.close())
        refuse(job, error);
}

} // namespace dynascope
