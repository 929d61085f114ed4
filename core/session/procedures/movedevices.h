// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"

#include <set>

namespace dynascope {

/// Told while a plan is carried out, on the bus thread.
struct MoveHooks {
    /// Before each step, with `next` naming it, and at the end: puts the plan where the next start of the program finds
    /// it. An error ends the moves before the step.
    std::function<Result<void>(const MovePlan &plan)> save;
    std::function<void(const MoveStep &step)> begun;
    std::function<void(const MoveStep &step, const Result<Found> &found)> ended;
};

/// What a plan has to know before it can be made.
struct MoveSurveyPlan {
    struct Secondary {
        DevicePlace place;
        std::uint16_t address = 0; ///< of its Secondary ID
    };
    std::vector<int> rates; ///< to be tried on the port, bits per second
    std::vector<Secondary> secondaries;
};
struct MoveSurvey {
    std::set<int> rates;                        ///< that the port does: set, with nothing sent, and put back
    std::vector<std::optional<int>> secondaries; ///< as asked for; none: it was silent, or refused
};
/// Writes nothing. An answer that says neither is an error: a Secondary ID that nobody knows may be in the way.
Result<MoveSurvey> surveyMoves(JobContext &context, const MoveSurveyPlan &plan);

/// Looks, before anything is written, whether it can end well: the port can do every rate (tried), each device is where
/// the plan has it, nobody is at the places to come. Also of a plan that was half done: the device of its begun step is
/// looked for at both of its places, and `plan.next` brought up to date. Errors say that nothing was written.
Result<void> checkMoves(JobContext &context, MovePlan &plan);

/// The step `plan.next` alone, verified; counts it up. `hooks.save` comes before it, not behind it.
Result<Found> moveOne(JobContext &context, MovePlan &plan, const MoveHooks &hooks);

/// Device by device, each verified at its new place before the next; where an answer is lost, looked for at the old
/// place, too. Begins at `plan.next` and counts it up. An error says where the device is, or that it is at neither
/// place; the same plan goes on from there, once what was wrong is put right.
Result<void> moveDevices(JobContext &context, MovePlan &plan, const MoveHooks &hooks);

} // namespace dynascope
