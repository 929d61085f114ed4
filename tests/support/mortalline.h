// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/simulatedline.h"

#include <functional>

namespace dynascope::test {

constexpr int Forever = 1'000'000;

/// A line whose program is killed: behind a given write nothing of it goes out, and nothing is read.
class MortalLine final : public Line
{
public:
    MortalLine(sim::SimulatedBus &bus, int baudRate, int writesLeft = Forever) : m_line(bus, baudRate), m_left(writesLeft)
    {
        m_line.advance(bus.now() + std::chrono::milliseconds(50));
    }

    QString name() const override { return m_line.name(); }
    LineTime now() const override { return m_line.now(); }
    Result<void> write(ByteView packet) override
    {
        const bool changes = packet[7] == static_cast<std::uint8_t>(Instruction::Write);
        if (m_dead)
            return failure(ErrorKind::PortLost, QStringLiteral("killed"));
        if (changes && m_left-- == 0) { // in the moment it sends this
            if (m_before || m_behind) {
                if (m_before)
                    m_before();
                const auto written = m_line.write(packet);
                if (m_behind)
                    m_behind();
                return written;
            }
            m_dead = true;
            if (m_lastGoesOut)
                (void)m_line.write(packet);
            return failure(ErrorKind::PortLost, QStringLiteral("killed"));
        }
        return m_line.write(packet);
    }
    Result<void> read(Bytes &buffer, LineTime deadline) override
    {
        if (m_dead)
            return failure(ErrorKind::PortLost, QStringLiteral("killed"));
        return m_line.read(buffer, deadline);
    }
    void discardInput() override { m_line.discardInput(); }
    int baudRate() const override { return m_line.baudRate(); }
    Result<void> setBaudRate(int bitsPerSecond) override { return m_line.setBaudRate(bitsPerSecond); }
    LineTime hostAllowance() const override { return m_line.hostAllowance(); }
    void refuse(int rate) { m_line.refuseBaudRate(rate); }
    void setLastGoesOut(bool out) { m_lastGoesOut = out; }
    /// At that write this happens instead of the kill; it and later ones go out as always.
    void setBefore(std::function<void()> before) { m_before = std::move(before); }
    void setBehind(std::function<void()> behind) { m_behind = std::move(behind); }
    void advance(LineTime duration) { m_line.advance(duration); }
    bool isDead() const { return m_dead; }
    bool wasReached() const { return m_left < 0; } ///< the write at which it happens was sent

private:
    sim::SimulatedLine m_line;
    int m_left;
    bool m_dead = false, m_lastGoesOut = true;
    std::function<void()> m_before, m_behind;
};

} // namespace dynascope::test
