// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/chance.h"
#include "core/sim/linefaults.h"
#include "core/sim/wire.h"

#include <deque>

namespace dynascope::sim {

/// The adapter between wire and program: hands on what the wire brings, in its order, when its timer, its delays and
/// its plug let it; picks up noise. Healthy, it does nothing.
class Adapter
{
public:
    void setFaults(const LineFaults &faults, LineTime now); ///< counts from here; what it holds it keeps

    /// How many of `packet`'s bytes leave before it is pulled out. Also damages and delays what comes back as echo.
    void send(Transmission &packet);
    /// In the order of the wire.
    void take(const std::vector<HeardByte> &bytes);
    void deliver(Bytes &to, LineTime now);
    /// When the first and the last byte of the latest deliver() that brought any were due.
    std::pair<LineTime, LineTime> delivered() const { return m_delivered; }

    std::optional<LineTime> next() const;  ///< when it hands on the next byte of those it has, or is pulled out
    std::optional<LineTime> quiet() const; ///< when the last of them
    bool isUnplugged() const { return m_unplugged; }

    std::optional<LineTime> nextNoise() const { return m_nextNoise; }
    void makeNoise(std::optional<LineTime> busyUntil); ///< at nextNoise(), or later where somebody speaks

private:
    void release(LineTime at);
    void unplug();
    LineTime noiseGap();

    struct Ready {
        LineTime at{};
        std::uint8_t byte = 0;
        bool answer = false;
    };
    LineFaults m_faults;
    Chance m_chance{1};
    std::vector<HeardByte> m_held; ///< until the timer ends or there are enough
    std::deque<Ready> m_ready;     ///< by time
    std::pair<LineTime, LineTime> m_delivered{};
    LineTime m_last{};             ///< of what went through m_ready
    std::optional<LineTime> m_unplugAt, m_nextNoise;
    int m_sent = 0, m_answered = 0; ///< bytes, since the faults were set
    bool m_unplugged = false;
};

} // namespace dynascope::sim
