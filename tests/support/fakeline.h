// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <deque>
#include <functional>
#include <map>
#include <optional>

/// A line in virtual time that answers from a script: reading jumps to the next byte or to the deadline.
class FakeLine final : public dynascope::Line
{
public:
    using Bytes = dynascope::Bytes;
    using LineTime = dynascope::LineTime;

    /// Bytes that begin to come `delay` after the request has left the wire, at the line's pace.
    struct Piece {
        LineTime delay{};
        Bytes bytes;
    };
    using Answer = std::vector<Piece>;
    /// Makes the answer to a request; asked only when no scripted one is left.
    using Handler = std::function<Answer(const Bytes &request)>;

    struct Sent {
        LineTime at{};
        int baudRate = 0;
        Bytes bytes;
    };

    explicit FakeLine(int baudRate = 1'000'000) : m_baudRate(baudRate) { }

    QString name() const override { return QStringLiteral("fake"); }
    LineTime now() const override { return m_now; }
    dynascope::Result<void> write(dynascope::ByteView packet) override;
    dynascope::Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return m_baudRate; }
    dynascope::Result<void> setBaudRate(int bitsPerSecond) override;
    LineTime hostAllowance() const override { return allowance; }

    /// The answer to the next request that has none yet.
    FakeLine &answer(Bytes bytes, LineTime delay = DefaultDelay);
    FakeLine &answer(Answer pieces);
    FakeLine &silence() { return answer(Answer{}); }
    /// Bytes that nobody asked for.
    void babble(LineTime at, const Bytes &bytes);

    LineTime allowance{};
    bool echo = false;
    bool unplugged = false;
    int refusedBaud = 0;
    Handler handler;
    std::vector<Sent> sent;

    static constexpr LineTime DefaultDelay = std::chrono::microseconds(500);

private:
    void schedule(LineTime begin, const Bytes &bytes);
    bool takeArrived(Bytes &buffer);

    int m_baudRate;
    LineTime m_now{};
    LineTime m_sentBy{};
    LineTime m_lastArrival{};
    std::deque<Answer> m_script;
    std::multimap<LineTime, std::uint8_t> m_arrivals;
};
