// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedline.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

tl::unexpected<Error> portLost()
{
    return failure(ErrorKind::PortLost, QStringLiteral("the simulated adapter is gone: unplugged"));
}

} // namespace

SimulatedLine::SimulatedLine(SimulatedBus &bus, int baudRate)
    : m_bus(bus)
    , m_now(bus.now())
    , m_baudRate(baudRate)
{
}

Result<void> SimulatedLine::write(ByteView packet)
{
    if (isUnplugged())
        return portLost();
    m_bus.send(packet, m_now, m_baudRate);
    return {};
}

Result<void> SimulatedLine::read(Bytes &buffer, LineTime deadline)
{
    const std::size_t before = buffer.size();
    for (;;) {
        m_bus.receive(buffer, m_now, m_baudRate);
        if (buffer.size() > before)
            return {};
        if (isUnplugged())
            return portLost();
        if (m_now >= deadline)
            return {};
        m_now = std::min(deadline, m_bus.nextArrival().value_or(deadline));
    }
}

void SimulatedLine::discardInput()
{
    m_bus.discardArrived(m_now);
}

Result<void> SimulatedLine::setBaudRate(int bitsPerSecond)
{
    if (isUnplugged())
        return portLost();
    if (bitsPerSecond <= 0 || bitsPerSecond == m_refusedBaud)
        return failure(ErrorKind::PortUnsuitable, QStringLiteral("The adapter can't do %1 bps").arg(bitsPerSecond));
    m_baudRate = bitsPerSecond;
    return {};
}

} // namespace dynascope::sim
