// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionround.h"
#include "tests/support/mortalline.h"
#include "tests/support/sessionfixture.h"

#include <QTemporaryDir>

namespace dynascope::test {

/// Servos that lie on the bench, unplugged, and a line into which they are plugged one after the other.
struct CommissionWorld {
    CommissionWorld(const Catalog &models, const QString &servos) : catalog(models), bus(models)
    {
        populate(bus, catalog, servos);
        for (const auto &servo : bus.servos()) {
            all.push_back(servo.get());
            servo->setPlugged(false);
        }
        restart();
    }
    sim::Servo &servo(std::size_t index) { return *all.at(index); }
    void plug(std::size_t index) { setPlugged(index, true); }
    void unplug(std::size_t index) { setPlugged(index, false); }
    void setPlugged(std::size_t index, bool plugged)
    {
        bus.advanceTo(line->now());
        servo(index).setPlugged(plugged);
        line->advance(std::chrono::seconds(1));
        bus.advanceTo(line->now());
    }
    /// The program once more; it is killed at a write.
    void restart(int writesLeft = Forever)
    {
        line = std::make_unique<MortalLine>(bus, 57600, writesLeft);
        program = std::make_unique<Bus>(*line, &stop);
        memory = {};
    }
    /// `count` joints of a model from `firstId` on.
    void want(const QString &model, int firstId, int count, int baudRate, std::vector<CommissionSetting> settings = {},
              int minimumFirmware = 0)
    {
        std::vector<CommissionJoint> joints;
        for (int i = 0; i < count; ++i)
            joints.push_back({QStringLiteral("joint%1").arg(i), catalog.model(model)->modelNumber, minimumFirmware,
                              {baudRate, firstId + i}, settings});
        auto made = CommissionList::make(catalog, joints);
        if (!made)
            qFatal("%s", qPrintable(made.error().text));
        list = std::move(*made);
    }
    Result<CommissionRound> round(const CommissionHooks &hooks = {})
    {
        bus.setLogging(true);
        bus.clearLog();
        DirectContext context(*program);
        context.atCheckpoint = atCheckpoint;
        auto result = commissionRound(context, plan(), hooks);
        if (result) {
            list = result->list;
            memory = result->memory;
        }
        return result;
    }
    CommissionRoundPlan plan() const
    {
        return {catalog, list, memory, options, MoveFile(folder.path(), QStringLiteral("simulated"), {}),
                QStringLiteral("simulated"), {}};
    }
    QString problem(const Result<CommissionRound> &result) const
    {
        return result ? result->problem : result.error().text;
    }
    /// Packets since the last round began that change anything.
    int writes() const
    {
        int count = 0;
        for (const sim::WireEntry &entry : bus.log())
            count += entry.fromController && changes(entry.bytes[7]) ? 1 : 0;
        return count;
    }
    static bool changes(std::uint8_t instruction)
    {
        return instruction != static_cast<std::uint8_t>(Instruction::Ping)
               && instruction != static_cast<std::uint8_t>(Instruction::Read);
    }

    const Catalog &catalog;
    QTemporaryDir folder;
    sim::SimulatedBus bus;
    std::vector<sim::Servo *> all;
    std::unique_ptr<MortalLine> line;
    std::atomic<bool> stop = false;
    std::unique_ptr<Bus> program;
    CommissionList list;
    CommissionMemory memory;
    CommissionOptions options;
    std::function<Result<void>()> atCheckpoint;
};

} // namespace dynascope::test
