// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/result.h"

#include <QString>

#include <chrono>
#include <optional>

namespace dynascope {

/// A moment on a line's own clock. Serial lines use the machine's monotonic clock (std::chrono::steady_clock since its
/// epoch), the simulated line virtual time. Never the wall clock.
using LineTime = std::chrono::nanoseconds;

constexpr double UartTolerance = 0.03; ///< by how much two rates may differ and still be understood

/// A half-duplex wire and its port. Lives on one thread; nothing here may be called from another.
class Line
{
public:
    virtual ~Line() = default;
    Line() = default;
    Line(const Line &) = delete;
    Line &operator=(const Line &) = delete;

    virtual QString name() const = 0; ///< as the person gave it: "/dev/ttyUSB0", "sim"
    virtual LineTime now() const = 0;

    /// Hands one whole packet to the port and returns without waiting for it to leave: a gap of more than 1.5 ms
    /// inside a packet would make devices drop it. Fails with PortLost.
    virtual Result<void> write(ByteView packet) = 0;

    /// Appends what has come to `buffer` and returns as soon as that is at least one byte, else at `deadline` with
    /// nothing. Never waits where `deadline` has passed. Fails with PortLost.
    virtual Result<void> read(Bytes &buffer, LineTime deadline) = 0;

    /// Forgets what has come and was not read. What is being sent is never touched.
    virtual void discardInput() = 0;

    virtual int baudRate() const = 0; ///< bits per second
    /// The caller has drained the line. Waits for nothing but a server's word, on the network. Fails with PortUnsuitable
    /// where the port can't do it (more than 3 % off); the old rate stays.
    virtual Result<void> setBaudRate(int bitsPerSecond) = 0;
    /// False: somebody else decides on the rate, baudRate() is what we were told, and setBaudRate() always fails.
    virtual bool canSetBaudRate() const { return true; }

    /// How late an answer may come through on account of the host: adapter latency, scheduling.
    virtual LineTime hostAllowance() const = 0;

    /// So long the adapter holds back what came, where the system tells.
    virtual std::optional<LineTime> latencyTimer() const { return std::nullopt; }
    /// A person wants bytes as they come. Fails with PortUnsuitable, saying how else it can be had.
    virtual Result<void> lowerLatency();

    /// 10 bit times: 8 data bits, start, stop.
    LineTime byteTime() const { return LineTime(10'000'000'000LL / baudRate()); }
};

} // namespace dynascope
