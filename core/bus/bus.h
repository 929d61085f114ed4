// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/bus/traits.h"
#include "core/protocol/requests.h"

#include <atomic>
#include <functional>

namespace dynascope {

/// One device's answer.
struct Reply {
    std::uint8_t id = 0;
    DeviceError error = DeviceError::None;
    bool alert = false; ///< Hardware Error Status is latched; never itself a failure
    Bytes data;
    LineTime at{}; ///< when its last byte had come
};

/// What the line did during one exchange, for messages and statistics.
struct Observations {
    std::size_t bytesReceived = 0;
    std::size_t noiseBytes = 0;
    int damagedPackets = 0;
    int strayPackets = 0;            ///< valid, but not asked for
    std::vector<std::uint8_t> strayIds;
    bool echo = false;               ///< the request itself came back first
    int retries = 0;
    LineTime roundTrip{};            ///< write to last reply
};

/// Everything a request brought. One entry per expected reply, in the order of the request; with a broadcast Ping one
/// per device that answered.
struct ExchangeResult {
    std::vector<Result<Reply>> replies; ///< errors name the device and what was seen
    Observations seen;
};

/// Counts since the line was opened.
struct BusStatistics {
    quint64 exchanges = 0;
    quint64 replies = 0;
    quint64 timeouts = 0;    ///< nothing received, no header, cut off
    quint64 crcErrors = 0;
    quint64 lengthErrors = 0;
    quint64 strays = 0;
    quint64 retries = 0;
    quint64 bytesSent = 0;
    quint64 bytesReceived = 0;
    LineTime busy{};         ///< time spent inside exchanges

    friend bool operator==(const BusStatistics &, const BusStatistics &) = default;
};

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

    /// Waits until `quiet` long nothing has come, and discards it; at most `limit`.
    Result<void> settle(LineTime quiet, LineTime limit);

    /// Drain, set, discard, two byte times. Error: the old rate stays.
    Result<void> setBaudRate(int bitsPerSecond);

    bool isStopped() const { return m_stop && m_stop->load(std::memory_order_acquire); }
    const BusStatistics &statistics() const { return m_statistics; }

    /// Called with each packet as it goes out or comes in, for the traffic view and `dxl -v`.
    enum class Direction { Sent, Received };
    using Tap = std::function<void(Direction, LineTime, ByteView)>;
    void setTap(Tap tap) { m_tap = std::move(tap); }

private:
    Line &m_line;
    const std::atomic<bool> *m_stop;
    std::vector<Traits> m_traits;
    BusStatistics m_statistics;
    Tap m_tap;
};

} // namespace dynascope
