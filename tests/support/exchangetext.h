// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"
#include "tests/support/fakeline.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"

#include <QRegularExpression>
#include <QStringList>

/// Answers to make and results to read, for tests of exchanges: what came is compared as text.
namespace exchangetext {

using namespace dynascope;
using namespace std::chrono_literals;

inline const Bytes Position{0xA6, 0, 0, 0};

inline Bytes position(std::uint8_t id)
{
    return oracle::status(id, 0, Position);
}

inline Bytes firstBytes(const Bytes &bytes, int count)
{
    return {bytes.begin(), bytes.begin() + count};
}

inline Bytes damaged(Bytes bytes)
{
    bytes[9] ^= 0x20;
    return bytes;
}

inline Bytes join(std::initializer_list<Bytes> parts)
{
    Bytes all;
    for (const Bytes &part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

inline Request readPosition(std::uint8_t id = 3)
{
    return readRequest({id, 132, 4});
}

inline Request syncRead(const std::vector<std::uint8_t> &ids, bool fast = false)
{
    return syncReadRequest(132, 4, ids, fast);
}

inline QString toText(const Result<Reply> &reply)
{
    if (!reply)
        return reply.error().text;
    const QString alert = reply->alert ? QStringLiteral(" alert") : QString();
    return QStringLiteral("%1: %2%3").arg(reply->id).arg(hex::text(reply->data), alert);
}

/// How long was waited in vain is for other tests to say.
inline QString untimed(QString text)
{
    return text.replace(QRegularExpression(QStringLiteral("within [0-9.]+ m?s")), QStringLiteral("in time"));
}

inline QStringList toText(const Result<ExchangeResult> &result)
{
    if (!result)
        return {result.error().text};
    QStringList lines;
    for (const Result<Reply> &reply : result->replies)
        lines << untimed(toText(reply));
    return lines;
}

/// One after the other, each half a millisecond behind the one before it, at 1 Mbps.
inline FakeLine::Answer inOrder(const QList<Bytes> &packets)
{
    FakeLine::Answer pieces;
    LineTime at = 500us;
    for (const Bytes &packet : packets) {
        pieces.push_back({at, packet});
        at += static_cast<LineTime::rep>(packet.size()) * 10us + 500us;
    }
    return pieces;
}

} // namespace exchangetext
