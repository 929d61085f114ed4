// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"
#include "tests/support/oracle.h"

#include <QString>

#include <chrono>

namespace simclient {

using namespace std::chrono_literals;
using dynascope::Bytes;
using dynascope::LineTime;

/// "01 07 84 00" → bytes.
inline Bytes hex(const QString &text)
{
    const QByteArray raw = QByteArray::fromHex(text.toLatin1());
    return Bytes(raw.begin(), raw.end());
}

inline QString hex(const Bytes &bytes)
{
    const QByteArray raw(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    return QString::fromLatin1(raw.toHex(' ').toUpper());
}

/// "ID INSTRUCTION parameters..." → a packet, by the oracle.
inline Bytes instruction(const QString &text)
{
    const Bytes raw = hex(text);
    return oracle::instruction(raw.at(0), raw.at(1), Bytes(raw.begin() + 2, raw.end()));
}

/// "ID ERROR parameters..." → a packet, by the oracle; nothing for nothing.
inline Bytes status(const QString &text)
{
    const Bytes raw = hex(text);
    return raw.empty() ? Bytes() : oracle::status(raw.at(0), raw.at(1), Bytes(raw.begin() + 2, raw.end()));
}

/// A controller that knows nothing but bytes and time.
struct Client {
    dynascope::sim::SimulatedBus &bus;
    int baudRate = 57600;
    LineTime now{};
    LineTime firstByte{}; ///< of the last answer: when it had come, after the request's last bit

    /// Sends, and hears all that comes within `wait` of the request's last bit.
    Bytes exchange(const Bytes &packet, LineTime wait = 30ms)
    {
        bus.send(packet, now, baudRate);
        now += static_cast<LineTime::rep>(packet.size()) * LineTime(10'000'000'000LL / baudRate);
        const LineTime sent = now;
        const LineTime until = now + wait;
        Bytes heard;
        while (true) {
            const std::size_t before = heard.size();
            bus.receive(heard, now, baudRate);
            if (before == 0 && !heard.empty())
                firstByte = now - sent;
            const auto next = bus.nextArrival();
            if (!next || *next > until)
                break;
            now = *next;
        }
        now = until;
        bus.receive(heard, now, baudRate);
        return heard;
    }
    Bytes exchange(const QString &text, LineTime wait = 30ms) { return exchange(instruction(text), wait); }
    void exchangeAll(const QString &semicolonSeparated)
    {
        for (const QString &one : semicolonSeparated.split(u';', Qt::SkipEmptyParts))
            exchange(one);
    }
};

} // namespace simclient
