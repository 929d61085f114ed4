// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/lines.h"

#include <QCoreApplication>

namespace dynascope {

bool Lines::knows(const QString &name) const
{
    return name == SimulatedPortName || m_network.knows(name) || m_serial.knows(name);
}

void Lines::prepare(const QString &name)
{
    if (name != SimulatedPortName || m_demo)
        return;
    auto demo = sim::Demo::start(m_catalog);
    if (demo) {
        m_demo = std::move(*demo);
        m_demoPath = m_demo->path();
    } else {
        m_demoPath = tl::unexpected(demo.error());
    }
}

Result<std::unique_ptr<Line>> Lines::open(const QString &name, int baudRate)
{
    return openUnless(false, name, baudRate);
}

Result<std::unique_ptr<Line>> Lines::openUnless(const std::atomic<bool> &cancel, const QString &name, int baudRate)
{
    if (m_network.knows(name))
        return m_network.openUnless(cancel, name, baudRate);
    if (name != SimulatedPortName)
        return m_serial.open(name, baudRate);
    if (!m_demoPath)
        return tl::unexpected(m_demoPath.error());
    return m_serial.open(*m_demoPath, baudRate);
}

std::vector<PortInfo> Lines::ports() const
{
    std::vector<PortInfo> ports = m_serialPorts.ports();
    ports.push_back({SimulatedPortName, QCoreApplication::translate("Lines", "Simulated bus"), {}});
    return ports;
}

} // namespace dynascope
