// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/channel.h"
#include "core/bus/collector.h"
#include "core/bus/learnedtiming.h"
#include "core/bus/quality.h"
#include "core/bus/traits.h"

#include <bitset>

namespace dynascope {

/// One exchange after the other on one line: sends a request, waits until its deadline, takes the answer apart.
/// Belongs to the thread of its line; blocking. Deadlines follow the model of reference "Time": bytes to leave, return
/// delay, processing, adapter latency, per device in group reads; what the answers so far taught replaces the line's
/// own guess of the latency.
///
/// Every wait is cut into slices of at most 2 ms that look at the stop flag; once it is set the exchange ends with
/// ErrorKind::Stopped, and so does every further one until the flag is cleared.
class Bus
{
public:
    explicit Bus(Line &line, const std::atomic<bool> *stop = nullptr) : m_channel(line, stop) { }
    Bus(const Bus &) = delete;
    Bus &operator=(const Bus &) = delete;

    Line &line() { return m_channel.line(); }
    /// Of the devices concerned, each for its baud rate; those not listed are taken for factory-fresh.
    void setTraits(const std::vector<Traits> &traits);
    void addTraits(const Traits &device); ///< of one more, or anew; the others stay
    Traits traits(std::uint8_t id) const;

    /// Sends and collects. Retries what is idempotent up to `retries` times. Failures of the port come as an error of
    /// the whole, each device's own in its entry. Who is silent by its Status Return Level yields a reply without data
    /// at the deadline. Where a late answer to an earlier request could be mistaken for this one's, a Ping goes first.
    Result<ExchangeResult> exchange(const Request &request, int retries = 2);

    /// As exchange() without retries, into a result that is used again and again: from the second exchange alike on
    /// nothing is allocated. `packet` is the request's, as bytes; at most MaximumPacketSize.
    Result<void> exchangeInto(const Request &request, ByteView packet, ExchangeResult &result);

    /// As exchange(), and calls `found` with each answer to a broadcast Ping as it comes. `highestId` bounds the wait.
    Result<ExchangeResult> broadcastPing(int highestId, const Collector::Found &found);

    /// Sends and waits for the bytes to leave. Looks at no stop flag: this is what STOP uses.
    Result<void> sendOnly(ByteView packet);

    /// Lets an answer that may be under way end, as long as it takes by what was asked, and waits until `pause` long
    /// nothing has come or gone; at most `limit`. Discards what came. Looks at no stop flag.
    Result<void> letEnd(LineTime pause, LineTime limit);

    /// Lets time pass; what comes meanwhile is discarded.
    Result<void> wait(LineTime duration)
    {
        return m_channel.waitUntil(m_channel.now() + duration, Channel::Heed::Orders);
    }

    /// Drain, set, discard, two byte times. Error: the old rate stays.
    Result<void> setBaudRate(int bitsPerSecond);

    bool isStopped() const { return m_channel.isStopped(); }
    /// Who else has answered within the last seconds, by ID; nothing where nobody else was asked.
    std::optional<std::vector<std::uint8_t>> othersAlive(std::uint8_t but) const;
    BusStatistics statistics() const;
    LineQuality quality() const; ///< per device, too

    /// Once this is set no exchange begins or is repeated, and what is waited for ends with Cancelled as soon as the
    /// packet has left: a broadcast Ping may take 0.8 s, Clear 3 s. Not owned; may be null.
    void setCancel(const std::atomic<bool> *cancel) { m_channel.setCancel(cancel); }
    bool isCancelled() const { return m_channel.isCancelled(); }

    /// An idle line is looked at now and then, or nobody would notice that it was unplugged.
    void look() { (void)prepare(); }

    /// Why the line is gone, once a call to it failed with PortLost.
    const std::optional<Error> &lost() const { return m_channel.lost(); }

    /// Called with each packet as it goes out or comes in, for the traffic view and `dxl -v`.
    enum class Direction { Sent, Received };
    using Tap = std::function<void(Direction, LineTime, ByteView)>;
    void setTap(Tap tap);

private:
    friend class Asking;
    struct Waiting;

    Result<void> prepare();
    Result<bool> fence(std::uint8_t id);
    void learnBelated(ByteView bytes), carried(std::size_t bytes);
    Result<void> perform(const Request &request, ByteView packet, Waiting &waiting, ExchangeResult &result);
    Result<void> listen(const Request &request, Waiting &waiting);
    Result<LineTime> begin(ByteView packet);
    LineTime deadline(const Request &request, const Waiting &waiting) const;
    LineTime longestWait(const Request &request, const Waiting &waiting) const;
    LineTime allowance(const Request &request) const, answerEnd(const Request &request, LineTime sent) const;
    bool isMute(const Request &request, std::uint8_t id) const;
    bool mayBeEarlierPings(const Request &request, const ExchangeResult &result) const;
    void learn(const Request &request, const ExchangeResult &result, LineTime sent);
    void remember(const Request &request, const ExchangeResult &result, LineTime sent);
    bool isExpectedSilence(const Request &request) const;
    void explainSilence(const Request &request, ExchangeResult &result) const;

    Channel m_channel;
    LateAnswers m_late;
    Collector m_collector{m_late};
    LearnedTiming m_timing;
    Parser m_idle; ///< takes apart what comes while nobody waits
    QualityLog m_quality;
    LineTime m_answerEnd{}; ///< on the wire, of the last request
    std::array<Traits, 256> m_traits; ///< by ID, where m_known says so: the first listed
    std::vector<Traits> m_moreTraits; ///< of the same IDs at other rates
    std::bitset<256> m_known;
    std::array<LineTime, 256> m_heardAt{}, m_askedAt{}; ///< by ID; 0: never
    Tap m_tap;
    int m_asking = 0; ///< lives of Asking
    bool m_echoes = false, m_unsettled = false; ///< what is sent comes back; older answers may come
};

} // namespace dynascope
