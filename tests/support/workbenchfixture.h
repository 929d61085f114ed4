// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "core/session/scanner.h"
#include "core/session/stopcontrol.h"
#include "core/sim/simulatedline.h"
#include "core/table/catalog.h"
#include "ui/common/workbench.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace dynascope::test {

/// Opens "sim" and anything that begins with "/dev/": the same servos, made on the bus thread that will own them. Who
/// waits for an answer waits in virtual time; the wall's comes on top, or an idle line would stand still.
/// "/dev/forbidden" can't be opened; unplug() takes every wire away, plug() those that are not named.
class VirtualLines final : public LineFactory, public PortList
{
public:
    VirtualLines(const Catalog &catalog, QString servos)
        : m_catalog(catalog)
        , m_servos(std::move(servos))
    {
    }

    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) override
    {
        if (name == QStringLiteral("/dev/forbidden"))
            return failure(ErrorKind::PortForbidden, QStringLiteral("No permission to open /dev/forbidden"));
        if (m_unplugged)
            return failure(ErrorKind::PortNotFound, QStringLiteral("%1 isn't there").arg(name));
        const std::scoped_lock lock(m_mutex);
        if (m_plugged && !m_plugs.contains(name) && name != QStringLiteral("sim"))
            return failure(ErrorKind::PortNotFound, QStringLiteral("%1 isn't there").arg(name));
        std::shared_ptr<std::atomic<bool>> &out = m_plugs[name];
        if (!out)
            out = std::make_shared<std::atomic<bool>>(false);
        return std::make_unique<VirtualLine>(m_catalog, m_servos, name, baudRate, m_unplugged, out);
    }

    std::vector<PortInfo> ports() const override
    {
        if (m_plugged)
            return *m_plugged;
        if (m_unplugged)
            return {{QStringLiteral("sim"), QStringLiteral("Simulated bus"), {}}};
        return {{QStringLiteral("/dev/ttyUSB0"), QStringLiteral("U2D2"), QStringLiteral("FT1")},
                {QStringLiteral("sim"), QStringLiteral("Simulated bus"), {}}};
    }

    void unplug(bool out = true) { m_unplugged = out; }

    /// From now on these ports are there and no other.
    void plug(std::vector<PortInfo> ports)
    {
        const std::scoped_lock lock(m_mutex);
        std::erase_if(m_plugs, [&ports](const auto &plug) {
            const bool stays = std::ranges::find(ports, plug.first, &PortInfo::name) != ports.end();
            if (!stays)
                *plug.second = true;
            return !stays;
        });
        for (const PortInfo &port : ports) {
            std::shared_ptr<std::atomic<bool>> &out = m_plugs[port.name];
            if (!out)
                out = std::make_shared<std::atomic<bool>>(false);
        }
        m_plugged = std::move(ports);
    }

private:
    class VirtualLine final : public Line
    {
    public:
        VirtualLine(const Catalog &catalog, const QString &servos, QString name, int baudRate,
                    const std::atomic<bool> &unplugged, std::shared_ptr<const std::atomic<bool>> out)
            : m_bus(catalog), m_name(std::move(name)), m_unplugged(unplugged), m_out(std::move(out))
        {
            const auto specs = sim::parseServoSpecs(servos, catalog);
            for (const sim::ServoSpec &spec : specs.value())
                m_bus.add(spec);
            m_bus.advanceTo(std::chrono::seconds(2)); // everybody has booted
            m_line = std::make_unique<sim::SimulatedLine>(m_bus, baudRate);
        }

        QString name() const override { return m_name; }
        LineTime now() const override
        {
            const LineTime present = wall();
            m_line->advance(present - std::exchange(m_wall, present));
            return m_line->now();
        }
        Result<void> write(ByteView packet) override
        {
            (void)now();
            return m_line->write(packet);
        }
        Result<void> read(Bytes &buffer, LineTime deadline) override
        {
            if (m_unplugged || *m_out)
                m_line->unplug();
            return m_line->read(buffer, deadline);
        }
        void discardInput() override { m_line->discardInput(); }
        int baudRate() const override { return m_line->baudRate(); }
        Result<void> setBaudRate(int bitsPerSecond) override { return m_line->setBaudRate(bitsPerSecond); }
        LineTime hostAllowance() const override { return m_line->hostAllowance(); }

    private:
        static LineTime wall() { return std::chrono::steady_clock::now().time_since_epoch(); }

        sim::SimulatedBus m_bus;
        mutable LineTime m_wall = wall(); ///< at the last look at the clock
        std::unique_ptr<sim::SimulatedLine> m_line;
        QString m_name;
        const std::atomic<bool> &m_unplugged;
        const std::shared_ptr<const std::atomic<bool>> m_out;
    };

    const Catalog &m_catalog;
    QString m_servos;
    std::atomic<bool> m_unplugged = false;
    std::mutex m_mutex; ///< ports come and go on the GUI's thread, are opened on others
    std::map<QString, std::shared_ptr<std::atomic<bool>>> m_plugs; ///< true: pulled out
    std::optional<std::vector<PortInfo>> m_plugged;                ///< what plug() said
};

/// All the window's parts work on, over VirtualLines. Nothing is polled: virtual time would run without end.
struct WorkbenchFixture {
    explicit WorkbenchFixture(const QString &servos = QStringLiteral("XM430-W350@1000000:1,XL430-W250@1000000:4,"
                                                                     "XL330-M288@57600:1"))
        : catalog(Catalog::builtIn().value())
        , lines(catalog, servos)
        , session(lines, catalog)
        , commands(session)
        , monitor(session)
        , stop(session, commands)
    {
        monitor.setPaused(true);
    }

    Workbench workbench() { return {session, commands, monitor, scanner, stop, lines}; }
    Device *device(int id, int baudRate)
    {
        return session.lines().empty() ? nullptr
                                       : session.lines().front()->deviceAt(static_cast<std::uint8_t>(id), baudRate);
    }

    Catalog catalog;
    VirtualLines lines;
    Session session;
    Commands commands;
    Monitor monitor;
    Scanner scanner;
    StopControl stop;
};

} // namespace dynascope::test
