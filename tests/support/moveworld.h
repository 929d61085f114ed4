// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/deviceplace.h"
#include "core/session/procedures/movedevices.h"
#include "tests/support/mortalline.h"
#include "tests/support/servoimage.h"
#include "tests/support/sessionfixture.h"

namespace dynascope::test {

inline std::vector<MoveDevice> devicesOf(const sim::SimulatedBus &bus, const std::vector<MovePlace> &goals)
{
    std::vector<MoveDevice> devices;
    for (std::size_t i = 0; i < bus.servos().size(); ++i) {
        const sim::Servo &servo = *bus.servos()[i];
        const Found found{static_cast<std::uint8_t>(servo.id()),
                          servo.baudRate(),
                          static_cast<std::uint16_t>(servo.table().modelNumber()),
                          static_cast<std::uint8_t>(servo.firmware()),
                          false,
                          {}};
        devices.push_back(moveDevice(found, servo.table(), QStringLiteral("%1 #%2").arg(servo.model()).arg(servo.id())));
        devices.back().goal = goals[i];
    }
    return devices;
}

/// Servos 1, 2, 3... at 57 600, with an EEPROM of their own, that are moved.
struct MoveWorld {
    MoveWorld(const Catalog &catalog, const std::vector<MovePlace> &theGoals) : bus(catalog), goals(theGoals)
    {
        QStringList models;
        for (std::size_t id = 1; id <= goals.size(); ++id)
            models << QStringLiteral("XM430-W350@57600:%1").arg(id);
        populate(bus, catalog, models.join(u','));
        for (const auto &servo : bus.servos()) {
            servos.push_back(servo.get());
            servo->write(u"Moving Threshold", 20 + servo->id());
            servo->write(u"Max Position Limit", 4000 - servo->id());
        }
        settle();
        before = imageOf(bus);
    }

    MovePlan plan() const { return *planMoves(devicesOf(bus, goals)); }
    void settle() { bus.advanceTo(bus.now() + std::chrono::seconds(1)); }
    static Result<void> move(Line &line, MovePlan &plan, const MoveHooks &hooks)
    {
        Bus program(line);
        DirectContext context(program);
        const auto checked = checkMoves(context, plan);
        return checked ? moveDevices(context, plan, hooks) : checked;
    }
    QString again(MovePlan &plan) ///< on a good line; empty: done
    {
        MortalLine line(bus, 57600, Forever);
        const Result<void> moved = move(line, plan, {});
        settle();
        return moved ? QString() : moved.error().text;
    }
    int replies() const ///< on the wire, since it is logged
    {
        return static_cast<int>(
            std::ranges::count_if(bus.log(), [](const sim::WireEntry &entry) { return !entry.fromController; }));
    }
    QStringList wrong() const ///< who isn't where it shall be
    {
        QStringList all;
        for (std::size_t i = 0; i < servos.size(); ++i) {
            const MovePlace place{servos[i]->baudRate(), servos[i]->id()};
            if (place != goals[i])
                all << placeText(place);
        }
        return all;
    }
    /// Whatever is at none of the places that the plan has for it, or not alone there, or not as it was.
    QStringList strange(const MovePlan &plan) const
    {
        std::set<MovePlace> places;
        ServoImage now = imageOf(bus);
        QStringList all;
        for (std::size_t i = 0; i < servos.size(); ++i) {
            const MovePlace place{servos[i]->baudRate(), servos[i]->id()};
            const bool isPlanned = std::ranges::any_of(plan.steps, [&](const MoveStep &step) {
                return step.device == i && (step.from == place || step.to == place);
            });
            if (!isPlanned || !places.insert(place).second)
                all << QStringLiteral("servo %1 at %2").arg(i + 1).arg(placeText(place));
            for (const QString &name : {QStringLiteral("ID"), QStringLiteral("Baud Rate")})
                now[{static_cast<int>(i) + 1, name}] = before.at({static_cast<int>(i) + 1, name});
        }
        return all + differences(before, now);
    }

    sim::SimulatedBus bus;
    std::vector<MovePlace> goals;
    std::vector<sim::Servo *> servos;
    ServoImage before;
};

} // namespace dynascope::test
