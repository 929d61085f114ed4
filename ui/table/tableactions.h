// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/ramguard.h"
#include "core/session/device.h"
#include "core/result.h"

#include <functional>
#include <set>

namespace dynascope {

struct Workbench;

/// What the table asks of the rest of the program; everything a click here can cause. Tests hand in their own.
struct TableActions {
    std::function<void(Device &, int field, std::int64_t raw)> write;
    /// `done` with the outcome, on the GUI thread, not before torqueOff has returned.
    std::function<void(const std::vector<Device *> &, std::function<void(Result<void>)> done)> torqueOff;
    std::function<void(Device &)> readAll;
    std::function<bool(const Watch &)> isWatched;
    /// Was it set in this session, and goes with the power?
    std::function<RamState(const Watch &)> ramState = {};
    /// Sets again what was lost by a restart; `done` with the outcome.
    std::function<void(const std::vector<Device *> &, std::function<void(Result<void>)> done)> setAgain = {};
    /// A register that may only be tried (Field::mayBeTried), after a person has insisted.
    std::function<void(Device &, int field, std::int64_t raw)> writeUnknown = {};
    /// The safe way of a write with consequences (consequencesdialog.h); of Torque Enable: on, with the goal at rest.
    std::function<void(Device &, int field, std::int64_t raw, bool torqueBack)> writeSafely = {};
    /// Which fields of long runs are in sight (Monitor::setUnfolded).
    std::function<void(const std::set<Watch> &fields)> setUnfolded = {};
};

/// Of this workbench; nothing where it has no settings.
std::function<void(Device &, int field, std::int64_t raw, bool torqueBack)> safeWrites(const Workbench &workbench);
TableActions tableActions(const Workbench &workbench);

} // namespace dynascope
