// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "core/table/catalog.h"
#include "core/table/usertables.h"
#include "tests/support/dxlprocess.h"

namespace dynascope::test {

/// A simulated bus that this process serves to runs of `dxl`: what went over its wire can be looked at.
class DxlBus
{
public:
    /// MODEL@BAUD:ID, joined by commas; `tables`: a folder of more models, which dxl doesn't know. path() is empty where
    /// that failed.
    explicit DxlBus(const QString &devices, const QString &tables = {})
    {
        auto catalog = Catalog::builtIn();
        if (!catalog)
            return;
        m_catalog = std::make_unique<Catalog>(std::move(*catalog));
        if (!tables.isEmpty())
            (void)addUserTables(*m_catalog, tables);
        auto bus = std::make_unique<sim::SimulatedBus>(*m_catalog);
        const auto specs = sim::parseServoSpecs(devices, *m_catalog);
        for (const sim::ServoSpec &spec : specs.value_or(std::vector<sim::ServoSpec>()))
            (void)bus->add(spec);
        bus->setLogging(true);
        auto server = sim::PtyServer::start(std::move(bus));
        if (server)
            m_server = std::move(*server);
    }

    QString path() const { return m_server ? m_server->path() : QString(); }
    const Catalog &catalog() const { return *m_catalog; }

    /// A loaded machine may take its time: nobody is called silent for that.
    QStringList with(const QStringList &arguments) const
    {
        return QStringList{QStringLiteral("--port"), path(), QStringLiteral("--timeout"), QStringLiteral("400")}
               + arguments;
    }
    Outcome dxl(const QStringList &arguments) const { return test::dxl(with(arguments)); }
    Outcome dxl(const char16_t *words) const { return dxl(QString::fromUtf16(words).split(u' ')); }

    void call(std::function<void(sim::SimulatedBus &, LineTime)> change) { m_server->call(std::move(change)); }
    /// What a controller sent since the last forget(), in order.
    std::vector<Bytes> sent()
    {
        std::vector<Bytes> all;
        call([&](sim::SimulatedBus &bus, LineTime) {
            for (const sim::WireEntry &entry : bus.log()) {
                if (entry.fromController)
                    all.push_back(entry.bytes);
            }
        });
        return all;
    }
    void forget()
    {
        call([](sim::SimulatedBus &bus, LineTime) { bus.clearLog(); });
    }
    std::int64_t value(int id, int baudRate, QStringView name)
    {
        std::int64_t raw = -1;
        call([&](sim::SimulatedBus &bus, LineTime) { raw = bus.servo(id, baudRate)->value(name); });
        return raw;
    }
    void set(int id, int baudRate, QStringView name, std::int64_t raw)
    {
        call([&](sim::SimulatedBus &bus, LineTime) { bus.servo(id, baudRate)->write(name, raw); });
    }
    void unplug() { m_server.reset(); }

private:
    std::unique_ptr<Catalog> m_catalog; ///< outlives the bus
    std::unique_ptr<sim::PtyServer> m_server;
};

/// One sentence: a line that begins with the program's name and ends there.
inline bool isOneSentence(const QString &text)
{
    return text.startsWith(u"dxl: ") && text.count(u'\n') == 1 && text.endsWith(u'\n');
}

} // namespace dynascope::test
