// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/simulatedbus.h"

#include <QStringList>

namespace dynascope::sim {

/// A bus to be made: from a list of devices, or from a file (resources/buses/FORMAT.md).
struct BusPlan {
    /// One shaft and what it turns.
    struct Axis {
        QString name{};
        std::optional<double> inertia{}, gravity{}, torque{}; ///< kg·m², N·m when horizontal, N·m
        std::optional<double> angle{};                        ///< degrees, where it stands at first
        std::optional<std::pair<double, double>> stops{};     ///< degrees
    };
    struct Register {
        QString name;
        std::int64_t value = 0;
        QString where{}; ///< for messages: "file:line:column"
    };
    struct Device {
        ServoSpec spec{};
        std::optional<double> supply{}; ///< V
        std::vector<Register> registers{}; ///< raw, written in this order
        std::vector<Axis> axes = std::vector<Axis>(1);
    };
    std::optional<std::uint64_t> seed{};
    std::optional<double> supply{}, temperature{}; ///< V, °C around all
    LineFaults faults{};
    std::vector<Device> devices{};
};

constexpr int MostPlannedDevices = 253;

BusPlan planOf(const std::vector<ServoSpec> &specs);

/// `name`: of the file, for messages, which say file, line, column and what is wrong.
Result<BusPlan> readBusPlan(const QByteArray &yaml, const QString &name, const Catalog &catalog);

/// `catalog` outlives the bus.
Result<std::unique_ptr<SimulatedBus>> makeBus(const BusPlan &plan, const Catalog &catalog);
QStringList namesOf(const BusPlan &plan); ///< of the bus's servos, in their order

} // namespace dynascope::sim
