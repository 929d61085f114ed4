// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fakeline.h"

#include <algorithm>

using namespace dynascope;

Result<void> FakeLine::write(ByteView packet)
{
    if (unplugged)
        return failure(ErrorKind::PortLost, QStringLiteral("fake is gone"));
    const Bytes bytes(packet.begin(), packet.end());
    sent.push_back({m_now, m_baudRate, bytes});
    const LineTime begin = std::max(m_now, m_sentBy);
    m_sentBy = begin + static_cast<LineTime::rep>(bytes.size()) * byteTime();
    if (echo)
        schedule(begin, bytes);
    Answer pieces;
    if (!m_script.empty()) {
        pieces = std::move(m_script.front());
        m_script.pop_front();
    } else if (handler) {
        pieces = handler(bytes);
    }
    for (const Piece &piece : pieces) { // adapters delay, but keep the order
        const LineTime from = std::max(m_sentBy + piece.delay, m_lastArrival);
        schedule(from, piece.bytes);
        m_lastArrival = from + static_cast<LineTime::rep>(piece.bytes.size()) * byteTime();
    }
    return {};
}

Result<void> FakeLine::read(Bytes &buffer, LineTime deadline)
{
    if (unplugged)
        return failure(ErrorKind::PortLost, QStringLiteral("fake is gone"));
    if (takeArrived(buffer) || deadline <= m_now)
        return {};
    const bool comes = !m_arrivals.empty() && m_arrivals.begin()->first <= deadline;
    m_now = comes ? m_arrivals.begin()->first : deadline;
    takeArrived(buffer);
    return {};
}

void FakeLine::discardInput()
{
    Bytes ignored;
    takeArrived(ignored);
}

Result<void> FakeLine::setBaudRate(int bitsPerSecond)
{
    if (unplugged)
        return failure(ErrorKind::PortLost, QStringLiteral("fake is gone"));
    if (bitsPerSecond == refusedBaud)
        return failure(ErrorKind::PortUnsuitable, QStringLiteral("fake can't do that"));
    m_baudRate = bitsPerSecond;
    return {};
}

FakeLine &FakeLine::answer(Bytes bytes, LineTime delay)
{
    return answer(Answer{{delay, std::move(bytes)}});
}

FakeLine &FakeLine::answer(Answer pieces)
{
    m_script.push_back(std::move(pieces));
    return *this;
}

void FakeLine::babble(LineTime at, const Bytes &bytes)
{
    schedule(at, bytes);
}

void FakeLine::schedule(LineTime begin, const Bytes &bytes)
{
    for (std::size_t i = 0; i < bytes.size(); ++i)
        m_arrivals.emplace(begin + static_cast<LineTime::rep>(i + 1) * byteTime(), bytes[i]);
}

bool FakeLine::takeArrived(Bytes &buffer)
{
    bool any = false;
    while (!m_arrivals.empty() && m_arrivals.begin()->first <= m_now) {
        buffer.push_back(m_arrivals.begin()->second);
        m_arrivals.erase(m_arrivals.begin());
        any = true;
    }
    return any;
}
