// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/busthread.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"

/// A simulated bus in virtual time with a Bus on it, and a job context for procedures.
struct VirtualBus {
    explicit VirtualBus(const dynascope::Catalog &catalog, const QString &servos, int baudRate = 57600)
        : simulated(catalog)
    {
        const auto specs = dynascope::sim::parseServoSpecs(servos, catalog);
        if (!specs)
            qFatal("%s", qPrintable(specs.error().text));
        for (const dynascope::sim::ServoSpec &spec : *specs) {
            if (const auto added = simulated.add(spec); !added)
                qFatal("%s", qPrintable(added.error().text));
        }
        simulated.advanceTo(std::chrono::seconds(1)); // everybody has booted
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
