// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <algorithm>
#include <atomic>
#include <optional>

namespace dynascope {

/// A line as exchanges need it: knows when what was sent has left the wire, cuts every wait into slices that look at
/// the stop flag and the cancel flag, remembers that the port is gone. Bus thread.
class Channel
{
public:
    explicit Channel(Line &line, const std::atomic<bool> *stop = nullptr) : m_line(line), m_stop(stop) { }

    Line &line() { return m_line; }
    const Line &line() const { return m_line; }
    LineTime now() const { return m_line.now(); }
    bool isStopped() const { return m_stop && m_stop->load(std::memory_order_acquire); }
    /// Not owned; may be null.
    void setCancel(const std::atomic<bool> *cancel) { m_cancel = cancel; }
    bool isCancelled() const { return m_cancel && m_cancel->load(std::memory_order_acquire); }
    /// Stopped; or Cancelled, once what is on its way out has left: a port that is closed under it would cut it.
    Result<void> mayWait() const;

    /// Hands a packet to the port; returns when it begins to leave. Looks at no stop flag.
    Result<LineTime> send(ByteView packet);
    LineTime sentBy() const { return m_sentBy; } ///< when the last byte of the last packet has left
    LineTime lastByteAt() const { return m_lastByteAt; } ///< when something came last
    LineTime busyUntil() const { return std::max(m_lastByteAt, m_sentBy); } ///< since then nothing has come or gone
    void noteAnswered() { m_isAnswered = true; } ///< what was sent last, so that it has left
    bool isAnswered() const { return m_isAnswered; }
    ByteView lastSent() const { return m_lastSent; }

    /// What came until `until`, or at once where something did; valid until the next call. May be nothing.
    Result<ByteView> receive(LineTime until);

    enum class Heed { Orders, Nothing }; ///< orders: STOP and cancel
    /// What comes meanwhile is discarded.
    Result<void> waitUntil(LineTime time, Heed heed);
    /// Waits until nothing has come for `quiet`, at most for `limit`, and discards what did. Heeds orders.
    Result<void> settle(LineTime quiet, LineTime limit);
    /// Drain, set, discard, two byte times. Error: the old rate stays.
    Result<void> setBaudRate(int bitsPerSecond);

    quint64 bytesSent() const { return m_bytesSent; }
    quint64 bytesDiscarded() const { return m_bytesDiscarded; } ///< came while nobody waited for them
    void countDiscarded(std::size_t bytes) { m_bytesDiscarded += bytes; }

    /// Why the line is gone, once a call to it failed with PortLost.
    const std::optional<Error> &lost() const { return m_lost; }

private:
    template <typename T>
    Result<T> keep(Result<T> result);

    Line &m_line;
    const std::atomic<bool> *m_stop;
    const std::atomic<bool> *m_cancel = nullptr;
    std::optional<Error> m_lost;
    Bytes m_received, m_lastSent;
    LineTime m_sentBy{}, m_lastByteAt{};
    bool m_isAnswered = true;
    quint64 m_bytesSent = 0, m_bytesDiscarded = 0;
};

} // namespace dynascope
