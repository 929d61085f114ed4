// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"

namespace dynascope {

/// Told while a plan is carried out, on the bus thread.
struct MoveHooks {
    /// Before each step, with `next` naming it, and at the end: puts the plan where the next start of the program finds
    /// it. An error ends the moves before the step.
    std::function<Result<void>(const MovePlan &plan)> save;
    std::function<void(const MoveStep &step)> begun;
    std::function<void(const MoveStep &step, const Result<Found> &found)> ended;
};

/// Looks, before anything is written, whether it can end well: the port can do every rate (tried), each device is where
/// the plan has it, nobody is at the places to come. Also of a plan that was half done: the device of its begun step is
/// looked for at both of its places, and `plan.next` brought up to date. Errors say that nothing was written.
Result<void> checkMoves(JobContext &context, MovePlan &plan);

/// Device by device, each verified at its new place before the next; where an answer is lost, looked for at the old
/// place, too. Begins at `plan.next` and counts it up. An error says where the device is, or that it is at neither
/// place; the same plan goes on from there, once what was wrong is put right.
Result<void> moveDevices(JobContext &context, MovePlan &plan, const MoveHooks &hooks);

} // namespace dynascope
