// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/channel.h"

#include "core/bus/messages.h"
#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

/// Adapters hand the last bytes to the wire a little later than computed; a change of rate must not catch them.
constexpr LineTime DrainMargin = 2ms;

} // namespace

Result<void> Channel::mayWait() const
{
    if (isStopped())
        return tl::unexpected(messages::stopped());
    if (isCancelled() && m_line.now() >= m_sentBy)
        return tl::unexpected(messages::cancelled());
    return {};
}

Result<LineTime> Channel::send(ByteView packet)
{
    const LineTime begin = std::max(m_line.now(), m_sentBy);
    if (Result<void> written = keep(m_line.write(packet)); !written)
        return tl::unexpected(written.error());
    m_sentBy = begin + static_cast<LineTime::rep>(packet.size()) * m_line.byteTime();
    m_isAnswered = false;
    m_lastSent.assign(packet.begin(), packet.end());
    m_bytesSent += packet.size();
    return begin;
}

Result<ByteView> Channel::receive(LineTime until)
{
    m_received.clear();
    if (Result<void> read = keep(m_line.read(m_received, until)); !read)
        return tl::unexpected(read.error());
    if (!m_received.empty())
        m_lastByteAt = m_line.now();
    return ByteView(m_received);
}

Result<void> Channel::waitUntil(LineTime time, Heed heed)
{
    while (m_line.now() < time) {
        if (Result<void> may = heed == Heed::Orders ? mayWait() : Result<void>(); !may)
            return may;
        const Result<ByteView> received = receive(std::min(time, m_line.now() + timing::Slice));
        if (!received)
            return tl::unexpected(received.error());
        countDiscarded(received->size());
    }
    return {};
}

Result<void> Channel::settle(LineTime quiet, LineTime limit)
{
    const LineTime end = m_line.now() + limit;
    LineTime silentSince = m_line.now();
    while (m_line.now() < end && m_line.now() - silentSince < quiet) {
        if (Result<void> may = mayWait(); !may)
            return may;
        const Result<ByteView> received =
            receive(std::min({end, silentSince + quiet, m_line.now() + timing::Slice}));
        if (!received)
            return tl::unexpected(received.error());
        if (received->empty())
            continue;
        silentSince = m_line.now();
        countDiscarded(received->size());
    }
    m_line.discardInput();
    return {};
}

Result<void> Channel::setBaudRate(int bitsPerSecond)
{
    if (bitsPerSecond == m_line.baudRate())
        return {};
    const LineTime drained = m_sentBy + (m_isAnswered ? LineTime() : std::min(DrainMargin, m_line.hostAllowance()));
    if (drained > m_line.now()) {
        if (Result<void> waited = waitUntil(drained, Heed::Nothing); !waited)
            return waited;
    }
    if (Result<void> set = keep(m_line.setBaudRate(bitsPerSecond)); !set)
        return set;
    m_line.discardInput();
    if (Result<void> waited = waitUntil(m_line.now() + 2 * m_line.byteTime(), Heed::Nothing); !waited)
        return waited;
    m_line.discardInput();
    return {};
}

/// Remembers that the line is gone.
template <typename T>
Result<T> Channel::keep(Result<T> result)
{
    if (!result && result.error().kind == ErrorKind::PortLost)
        m_lost = result.error();
    return result;
}

} // namespace dynascope
