// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ptyserver.h"

#include "core/sim/packetassembler.h"
#include "core/sim/pseudoterminal.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <deque>
#include <future>
#include <mutex>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace dynascope::sim {
namespace {

using namespace std::chrono_literals;

constexpr LineTime TickPeriod = 10ms;
constexpr LineTime IdlePeriod = 500ms;  ///< motion is brought up to date, so that no long stretch piles up
constexpr LineTime LongestPiece = 1ms;  ///< of a reply, as an adapter hands bytes on
constexpr LineTime SpinTime = 150us;    ///< sleeping is no more exact than that

LineTime wallTime()
{
    return std::chrono::steady_clock::now().time_since_epoch();
}

using Change = std::function<void(SimulatedBus &, LineTime)>;

} // namespace

class PtyServer::Worker
{
public:
    Worker(std::unique_ptr<SimulatedBus> bus, std::unique_ptr<PseudoTerminal> terminal, QString link,
           Change onTick, std::function<void(const QString &)> onPacing, int wake)
        : m_bus(std::move(bus))
        , m_terminal(std::move(terminal))
        , m_onTick(std::move(onTick))
        , m_onPacing(std::move(onPacing))
        , m_path(m_terminal->path())
        , m_link(std::move(link))
        , m_wake(wake)
        , m_thread([this] { run(); })
    {
        pthread_setname_np(m_thread.native_handle(), "simulated bus");
    }

    ~Worker()
    {
        m_stop.store(true, std::memory_order_release);
        wake();
        m_thread.join();
        ::close(m_wake);
    }

    const QString &path() const { return m_path; }
    State state() const { return {m_terminal ? m_terminal->path() : QString(), m_pacing.report()}; }

    void post(Change change)
    {
        {
            const std::lock_guard lock(m_queueMutex);
            m_queue.push_back(std::move(change));
        }
        wake();
    }

private:
    void wake()
    {
        const std::uint64_t one = 1;
        while (::write(m_wake, &one, sizeof one) < 0 && errno == EINTR) { }
    }

    void run();
    void runPosted();
    void followPlug();
    bool noticeClients();
    void hearClient(LineTime now);
    void answerClient(LineTime now);
    void tick(LineTime now);
    void wait();
    LineTime coarseWake() const;

    std::unique_ptr<SimulatedBus> m_bus;
    std::unique_ptr<PseudoTerminal> m_terminal; ///< null while the bus's adapter is unplugged
    PacketAssembler m_assembler;
    Change m_onTick;
    std::function<void(const QString &)> m_onPacing;
    Pacing m_pacing;
    LineTime m_nextTick{}, m_overslept{}; ///< how much longer the last sleep was than it should
    bool m_someoneLeft = false; ///< noticed, but not heeded yet
    const QString m_path, m_link;
    const int m_wake; ///< an eventfd
    std::atomic<bool> m_stop = false;
    std::mutex m_queueMutex;
    std::deque<Change> m_queue;
    std::thread m_thread; ///< last: starts when all else stands
};

void PtyServer::Worker::run()
{
    m_bus->beginAt(wallTime());
    m_nextTick = wallTime();
    while (!m_stop.load(std::memory_order_acquire)) {
        if (m_terminal && noticeClients()) {
            hearClient(wallTime()); // its last words count
            m_bus->discardArrived(wallTime());
        }
        hearClient(wallTime());
        answerClient(wallTime());
        runPosted();
        tick(wallTime());
        followPlug();
        wait();
    }
}

/// True where one has left since this last said so.
bool PtyServer::Worker::noticeClients()
{
    const bool now = m_terminal->watchDescriptor() >= 0 && m_terminal->noticeClients();
    return std::exchange(m_someoneLeft, false) || now;
}

/// The terminal is the adapter: pulled out, its clients see it end and the link goes; plugged in, there is a new one.
void PtyServer::Worker::followPlug()
{
    if (m_bus->isUnplugged()) {
        m_terminal.reset();
        m_assembler.clear();
    } else if (!m_terminal) {
        if (auto opened = PseudoTerminal::open(m_link))
            m_terminal = std::move(*opened);
    }
}

void PtyServer::Worker::runPosted()
{
    std::deque<Change> changes;
    {
        const std::lock_guard lock(m_queueMutex);
        changes.swap(m_queue);
    }
    for (const Change &change : changes) {
        const LineTime now = wallTime();
        m_bus->advanceTo(now);
        change(*m_bus, now);
    }
}

void PtyServer::Worker::hearClient(LineTime now)
{
    if (!m_terminal)
        return;
    const Bytes bytes = m_terminal->read();
    if (!bytes.empty()) {
        // Who says something has come, noticed or not: on a busy machine its answer may be due before the next look.
        if (!m_terminal->hasClient())
            m_someoneLeft = noticeClients();
        m_assembler.feed(bytes, now);
        if (m_overslept > Pacing::Late)
            m_pacing.heardLate(m_overslept, now);
    }
    m_assembler.setPatience(m_bus->faults().bridgedGap);
    while (const auto packet = m_assembler.next(now))
        m_bus->send(*packet, m_assembler.fedAt(), m_terminal->baudRate());
}

void PtyServer::Worker::answerClient(LineTime now)
{
    Bytes reply;
    if (!m_terminal)
        return m_bus->discardArrived(now);
    m_bus->receive(reply, now, m_terminal->baudRate());
    if (reply.empty() || !m_terminal->hasClient())
        return;
    m_terminal->write(reply);
    if (m_bus->quietAt())
        return; // a piece of it
    const LineTime at = wallTime();
    const auto [first, last] = m_bus->arrived();
    m_pacing.handedOn(std::min(last, first + LongestPiece), at);
}

void PtyServer::Worker::tick(LineTime now)
{
    if (now < m_nextTick)
        return;
    m_bus->advanceTo(now);
    if (m_onTick)
        m_onTick(*m_bus, now);
    if (const auto news = m_pacing.news(now); news && m_onPacing)
        m_onPacing(*news);
    m_nextTick = now + (m_onTick ? TickPeriod : IdlePeriod);
}

/// When to look again, to a scheduler's exactness: nothing is said at that moment.
LineTime PtyServer::Worker::coarseWake() const
{
    LineTime wake = m_nextTick;
    if (const auto next = m_bus->nextArrival())
        wake = std::min(wake, *next);
    if (const auto deadline = m_assembler.deadline())
        wake = std::min(wake, *deadline);
    return wake;
}

void PtyServer::Worker::wait()
{
    const LineTime now = wallTime();
    const auto quiet = m_bus->quietAt();
    const LineTime exact = quiet ? std::min(*quiet, now + LongestPiece) : LineTime{};
    const LineTime sleep = (quiet ? exact - SpinTime : coarseWake()) - now;
    m_overslept = {};
    if (sleep > 0ns) {
        const timespec length{static_cast<time_t>(sleep / 1s), static_cast<long>((sleep % 1s).count())};
        std::array<pollfd, 3> waited{pollfd{m_terminal ? m_terminal->descriptor() : -1, POLLIN, 0},
                                     pollfd{m_wake, POLLIN, 0},
                                     pollfd{m_terminal ? m_terminal->watchDescriptor() : -1, POLLIN, 0}};
        const bool called = ppoll(waited.data(), waited.size(), &length, nullptr) > 0;
        m_overslept = wallTime() - now - sleep;
        if (called) {
            std::uint64_t count = 0;
            if ((waited[1].revents & POLLIN) && ::read(m_wake, &count, sizeof count) < 0 && errno != EINTR)
                return;
            return;
        }
    }
    while (quiet && wallTime() < exact) { }
}

PtyServer::PtyServer() = default;
PtyServer::~PtyServer() = default;

Result<std::unique_ptr<PtyServer>> PtyServer::start(std::unique_ptr<SimulatedBus> bus, const QString &link,
                                                    std::function<void(SimulatedBus &, LineTime)> onTick,
                                                    std::function<void(const QString &)> onPacing)
{
    auto terminal = PseudoTerminal::open(link);
    if (!terminal)
        return tl::unexpected(terminal.error());
    const int wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake < 0)
        return failure(ErrorKind::PortUnsuitable, QStringLiteral("The simulator needs more open files than allowed"));
    std::unique_ptr<PtyServer> server(new PtyServer);
    server->m_worker = std::make_unique<Worker>(std::move(bus), std::move(*terminal), link, std::move(onTick),
                                                std::move(onPacing), wake);
    return server;
}

PtyServer::State PtyServer::state() const
{
    return m_worker->state();
}

QString PtyServer::path() const
{
    return m_worker->path();
}

void PtyServer::post(std::function<void(SimulatedBus &, LineTime)> change)
{
    m_worker->post(std::move(change));
}

void PtyServer::call(std::function<void(SimulatedBus &, LineTime)> change)
{
    std::promise<void> done;
    m_worker->post([&](SimulatedBus &bus, LineTime now) {
        change(bus, now);
        done.set_value();
    });
    done.get_future().wait();
}

} // namespace dynascope::sim
