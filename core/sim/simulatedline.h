// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/simulatedbus.h"

namespace dynascope::sim {

/// A line in virtual time for tests: reading jumps straight to the next byte or the deadline. A test of a 16 ms timeout
/// takes microseconds and always ends the same way.
class SimulatedLine final : public Line
{
public:
    explicit SimulatedLine(SimulatedBus &bus, int baudRate = 57600); ///< `bus` outlives the line

    QString name() const override { return QStringLiteral("simulated"); }
    LineTime now() const override { return m_now; }
    Result<void> write(ByteView packet) override;
    Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return m_baudRate; }
    Result<void> setBaudRate(int bitsPerSecond) override;
    LineTime hostAllowance() const override { return m_hostAllowance; }
    std::optional<LineTime> latencyTimer() const override { return m_bus.faults().latencyTimer; }

    void advance(LineTime duration) { m_now += duration; } ///< lets virtual time pass
    void setHostAllowance(LineTime allowance) { m_hostAllowance = allowance; }
    void unplug() { m_unplugged = true; } ///< this line for good; the bus's faults can also plug it in again
    void refuseBaudRate(int bitsPerSecond) { m_refusedBaud = bitsPerSecond; } ///< as an adapter that can't do it

private:
    SimulatedBus &m_bus;
    LineTime m_now{};
    int m_baudRate;
    int m_refusedBaud = 0;
    LineTime m_hostAllowance{};
    bool m_unplugged = false;
    bool isUnplugged() const { return m_unplugged || m_bus.isUnplugged(); }

};

} // namespace dynascope::sim
