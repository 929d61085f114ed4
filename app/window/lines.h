// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"
#include "core/bus/networklinefactory.h"
#include "core/bus/seriallinefactory.h"
#include "core/sim/demo.h"

#include <memory>

namespace dynascope {

class Catalog;

inline constexpr QLatin1String SimulatedPortName("sim");

/// Every kind of line the window can open: serial ports, those behind a server on the network, and "sim", which is a
/// serial port too: the terminal on which the demo's simulated bus is served. The window opens all in the same way.
class Lines final : public LineFactory, public PortList
{
public:
    explicit Lines(const Catalog &catalog) : m_catalog(catalog) {}

    bool knows(const QString &name) const override;
    void prepare(const QString &name) override; ///< starts the demo, once; it then runs as long as this
    Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) override;
    Result<std::unique_ptr<Line>> openUnless(const std::atomic<bool> &cancel, const QString &name,
                                             int baudRate) override;
    std::vector<PortInfo> ports() const override;

    sim::Demo *demo() const { return m_demo.get(); } ///< nullptr before the first "sim"

private:
    const Catalog &m_catalog;
    SerialLineFactory m_serial;
    NetworkLineFactory m_network;
    SerialPortList m_serialPorts;
    std::unique_ptr<sim::Demo> m_demo;
    Result<QString> m_demoPath; ///< written before the first bus thread that reads it starts, never again
};

} // namespace dynascope
