// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
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
    /// A register that may only be tried (Field::mayBeTried), after a person has insisted.
    std::function<void(Device &, int field, std::int64_t raw)> writeUnknown = {};
    /// Which fields of long runs are in sight (Monitor::setUnfolded).
    std::function<void(const std::set<Watch> &fields)> setUnfolded = {};
};

TableActions tableActions(const Workbench &workbench);

} // namespace dynascope
