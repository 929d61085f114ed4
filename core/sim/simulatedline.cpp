// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedline.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

tl::unexpected<Error> portLost()
{
    return failure(ErrorKind::PortLost, QStringLiteral("The simulated adapter was unplugged"));
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
    if (m_unplugged)
        return portLost();
    m_bus.send(packet, m_now, m_baudRate);
    if (m_echo) {
        m_echoed.insert(m_echoed.end(), packet.begin(), packet.end());
        m_echoAt = std::max(m_now, m_echoAt) + static_cast<LineTime::rep>(packet.size()) * byteTime();
    }
    return {};
}

Result<void> SimulatedLine::read(Bytes &buffer, LineTime deadline)
{
    const std::size_t before = buffer.size();
    for (;;) {
        if (m_unplugged)
            return portLost();
        if (!m_echoed.empty() && m_echoAt <= m_now) {
            buffer.insert(buffer.end(), m_echoed.begin(), m_echoed.end());
            m_echoed.clear();
        }
        m_bus.receive(buffer, m_now, m_baudRate);
        if (buffer.size() > before || m_now >= deadline)
            return {};
        LineTime next = std::min(deadline, m_bus.nextArrival().value_or(deadline));
        if (!m_echoed.empty())
            next = std::min(next, m_echoAt);
        m_now = next;
    }
}

void SimulatedLine::discardInput()
{
    if (m_echoAt <= m_now)
        m_echoed.clear();
    m_bus.discardArrived(m_now);
}

Result<void> SimulatedLine::setBaudRate(int bitsPerSecond)
{
    if (m_unplugged)
        return portLost();
    if (bitsPerSecond <= 0 || bitsPerSecond == m_refusedBaud)
        return failure(ErrorKind::PortUnsuitable, QStringLiteral("The adapter can't do %1 bps").arg(bitsPerSecond));
    m_baudRate = bitsPerSecond;
    return {};
}

} // namespace dynascope::sim
