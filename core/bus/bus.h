// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus_values.h"
#include "core/bus/traits.h"

#include <atomic>
#include <functional>
#include <optional>

namespace dynascope {

class Collector;

/// One exchange after the other on one line: sends a request, waits until its deadline, takes the answer apart.
/// Belongs to the thread of its line; blocking. Deadlines follow the model of reference "Time": bytes to leave, return
/// delay, processing, adapter latency, per device in group reads.
///
/// Every wait is cut into slices of at most 2 ms that look at the stop flag; once it is set the exchange ends with
/// ErrorKind::Stopped, and so does every further one until the flag is cleared.
class Bus
{
public:
    explicit Bus(Line &line, const std::atomic<bool> *stop = nullptr);

    Line &line() { return m_line; }

    /// `traits` of the devices concerned, by ID; those not listed are taken for factory-fresh.
    void setTraits(std::vector<Traits> traits);
    Traits traits(std::uint8_t id) const;

    /// Sends and collects. Retries what is idempotent up to `retries` times. Total failures of the port come as an
    /// error of the whole; each device's own come in its entry. A device silent by its Status Return Level yields a
    /// reply without data at the deadline.
    Result<ExchangeResult> exchange(const Request &request, int retries = 2);

    /// As exchange(), and calls `found` with each answer to a broadcast Ping as it comes. `highestId` bounds the wait.
    Result<ExchangeResult> broadcastPing(int highestId, const std::function<void(const Reply &)> &found);

    /// Sends without waiting for anything but the bytes to leave. Looks at no stop flag: this is what STOP uses.
    Result<void> sendOnly(ByteView packet);

    /// Waits until `quiet` long nothing has come, and discards it; at most `limit`. Looks at no stop flag.
    Result<void> settle(LineTime quiet, LineTime limit) { return settleFor(quiet, limit, false); }

    /// Lets time pass; what comes meanwhile is discarded.
    Result<void> wait(LineTime duration) { return waitUntil(m_line.now() + duration, true); }

    /// Drain, set, discard, two byte times. Error: the old rate stays.
    Result<void> setBaudRate(int bitsPerSecond);

    bool isStopped() const { return m_stop && m_stop->load(std::memory_order_acquire); }
    const BusStatistics &statistics() const { return m_statistics; }

    /// Once this is set no exchange begins or is repeated, and what is waited for ends with Cancelled as soon as the
    /// packet has left: a broadcast Ping may take 0.8 s, Clear 3 s. Not owned; may be null.
    void setCancel(const std::atomic<bool> *cancel) { m_cancel = cancel; }
    bool isCancelled() const { return m_cancel && m_cancel->load(std::memory_order_acquire); }

    /// An idle line is looked at now and then, or nobody would notice that it was unplugged.
    void look() { (void)prepare(); }

    /// Why the line is gone, once a call to it failed with PortLost.
    const std::optional<Error> &lost() const { return m_lost; }

    /// Called with each packet as it goes out or comes in, for the traffic view and `dxl -v`.
    enum class Direction { Sent, Received };
    using Tap = std::function<void(Direction, LineTime, ByteView)>;
    void setTap(Tap tap) { m_tap = std::move(tap); }

private:
    struct Waiting;

    Result<ExchangeResult> attempt(const Request &request);
    Result<ExchangeResult> perform(const Request &request, Waiting &waiting);
    Result<void> prepare();
    Result<void> mayWait() const;
    Result<bool> fence(std::uint8_t id, Error &silence);
    Result<void> send(ByteView packet);
    Result<void> listen(Collector &collector, const Request &request, Waiting &waiting);
    Result<void> settleFor(LineTime quiet, LineTime limit, bool heedStop);
    Result<void> waitUntil(LineTime time, bool heedStop);
    Result<void> receive(LineTime until);
    LineTime deadline(const Collector &collector, const Request &request, const Waiting &waiting) const;
    void explainSilence(const Request &request, ExchangeResult &result) const;
    void count(const ExchangeResult &result);
    Result<void> keep(Result<void> result);

    Line &m_line;
    const std::atomic<bool> *m_stop;
    const std::atomic<bool> *m_cancel = nullptr;
    std::vector<Traits> m_traits;
    BusStatistics m_statistics;
    Tap m_tap;
    std::optional<Error> m_lost;
    Bytes m_received; ///< what the last read brought
    Bytes m_lastSent;
    LineTime m_sentBy{};      ///< when the last byte of the last packet has left
    bool m_echoes = false;    ///< the adapter returns what is sent
    bool m_unsettled = false; ///< something is or may be coming that belongs to an earlier request
    bool m_doubtful = false;  ///< an answer was missed and may still come: only an answered Ping proves that it won't
};

} // namespace dynascope
