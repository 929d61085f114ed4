// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/stopcontrol.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"

#include <QCoreApplication>
#include <QDeadlineTimer>

/// Puts servos on a bus and lets them boot.
inline void populate(dynascope::sim::SimulatedBus &simulated, const dynascope::Catalog &catalog, const QString &servos)
{
    const auto specs = dynascope::sim::parseServoSpecs(servos, catalog);
    if (!specs)
        qFatal("%s", qPrintable(specs.error().text));
    for (const dynascope::sim::ServoSpec &spec : *specs) {
        if (const auto added = simulated.add(spec); !added)
            qFatal("%s", qPrintable(added.error().text));
    }
    simulated.advanceTo(std::chrono::seconds(1));
}

/// A simulated bus in virtual time with a Bus on it, and a job context for procedures.
struct VirtualBus {
    explicit VirtualBus(const dynascope::Catalog &catalog, const QString &servos, int baudRate = 57600)
        : simulated(catalog)
    {
        populate(simulated, catalog, servos);
        line = std::make_unique<dynascope::sim::SimulatedLine>(simulated, baudRate);
        line->advance(std::chrono::seconds(1));
        bus = std::make_unique<dynascope::Bus>(*line, &stop);
    }

    dynascope::sim::SimulatedBus simulated;
    std::unique_ptr<dynascope::sim::SimulatedLine> line;
    std::atomic<bool> stop = false;
    std::unique_ptr<dynascope::Bus> bus;
};

/// Runs a procedure right here. `atCheckpoint` is called at each checkpoint and may end it.
class DirectContext final : public dynascope::JobContext
{
public:
    explicit DirectContext(dynascope::Bus &bus) : m_bus(bus) {}

    dynascope::Bus &bus() override { return m_bus; }
    dynascope::Result<void> checkpoint() override
    {
        ++checkpoints;
        return atCheckpoint ? atCheckpoint() : dynascope::Result<void>();
    }
    void post(std::function<void()> note) override { note(); }

    std::function<dynascope::Result<void>()> atCheckpoint;
    int checkpoints = 0;
    bool wasExclusive = false;

protected:
    void enterExclusive() override { wasExclusive = true; }
    void leaveExclusive() override { }

private:
    dynascope::Bus &m_bus;
};

/// Opens one simulated bus in virtual time under any name. Look at it only while no line is open.
class VirtualFactory final : public dynascope::LineFactory
{
public:
    VirtualFactory(const dynascope::Catalog &catalog, const QString &servos)
        : simulated(catalog)
    {
        populate(simulated, catalog, servos);
    }

    bool knows(const QString &) const override { return true; }
    dynascope::Result<std::unique_ptr<dynascope::Line>> open(const QString &, int baudRate) override
    {
        return std::unique_ptr<dynascope::Line>(std::make_unique<TappedLine>(*this, baudRate));
    }

    dynascope::sim::SimulatedBus simulated;
    /// Told of each packet before it goes out, with how many there were by then. Bus thread.
    std::function<void(int count, dynascope::ByteView packet)> onPacket;
    std::function<bool(dynascope::ByteView packet)> isLost; ///< nobody hears such a packet
    std::atomic<dynascope::LineTime::rep> passing = 0; ///< so much virtual time goes by before the line's next look at it

private:
    class TappedLine final : public dynascope::Line
    {
    public:
        TappedLine(VirtualFactory &factory, int baudRate)
            : m_factory(factory)
            , m_line(factory.simulated, baudRate)
        {
        }

        QString name() const override { return m_line.name(); }
        dynascope::LineTime now() const override
        {
            m_line.advance(dynascope::LineTime(m_factory.passing.exchange(0)));
            return m_line.now();
        }
        dynascope::Result<void> write(dynascope::ByteView packet) override
        {
            if (m_factory.onPacket)
                m_factory.onPacket(++m_count, packet);
            if (m_factory.isLost && m_factory.isLost(packet))
                return {};
            return m_line.write(packet);
        }
        dynascope::Result<void> read(dynascope::Bytes &buffer, dynascope::LineTime deadline) override
        {
            return m_line.read(buffer, deadline);
        }
        void discardInput() override { m_line.discardInput(); }
        int baudRate() const override { return m_line.baudRate(); }
        dynascope::Result<void> setBaudRate(int bitsPerSecond) override { return m_line.setBaudRate(bitsPerSecond); }
        dynascope::LineTime hostAllowance() const override { return m_line.hostAllowance(); }

    private:
        VirtualFactory &m_factory;
        mutable dynascope::sim::SimulatedLine m_line;
        int m_count = 0;
    };
};

/// All of core on one line of virtual time. Nothing is polled.
struct VirtualSession {
    VirtualSession(const dynascope::Catalog &catalog, const QString &servos, dynascope::Journal *journal = nullptr)
        : factory(catalog, servos)
        , session(factory, catalog)
        , commands(session, journal)
        , stop(session, commands)
    {
    }

    /// Opens the line and tells it of every servo.
    void open(int baudRate)
    {
        std::vector<dynascope::Found> found;
        for (const auto &servo : factory.simulated.servos())
            found.push_back({static_cast<std::uint8_t>(servo->id()), servo->baudRate(),
                             static_cast<std::uint16_t>(servo->table().modelNumber()),
                             static_cast<std::uint8_t>(servo->firmware()), false, {}});
        line = &session.open(QStringLiteral("virtual"), baudRate);
        for (const dynascope::Found &each : found)
            line->heard(each);
    }
    void close() { session.close(*std::exchange(line, nullptr)); }
    /// Lets events come until `isSo`; false where that takes 10 s of the wall's time.
    static bool waitFor(const std::function<bool()> &isSo)
    {
        const QDeadlineTimer limit(std::chrono::seconds(10));
        while (!isSo() && !limit.hasExpired()) // a line's own timer comes once a second
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        return isSo();
    }

    VirtualFactory factory;
    dynascope::Session session;
    dynascope::Commands commands;
    dynascope::StopControl stop;
    dynascope::LineSession *line = nullptr;
};
