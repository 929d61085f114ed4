// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionround.h"

namespace dynascope {

/// What is read of one that may be as wanted already.
struct BringIn {
    const CommissionRoundPlan &plan;
    const CommissionHooks &hooks;
    std::size_t joint = 0;
    Found found;
    std::vector<Found> others; ///< who else is on the line
};

/// Why this can't be one servo, by repeated reads: a sentence without a stop; empty: no sign. A servo at rest is
/// looked at more strictly than a scan does, which must not mistake one that moves.
Result<QString> doubtByReads(JobContext &context, const Found &found, const ControlTable &table);

/// Does it hold all that its joint wants, at the joint's place? Nothing is written.
Result<bool> isAsWanted(JobContext &context, const BringIn &what);

/// Checks, moves, sets up, reads back. `hasWritten` is set with the first write; an error before it says that nothing
/// was written.
Result<CommissionFacts> bringIn(JobContext &context, const BringIn &what, bool &hasWritten);

/// Where the half done one of an ended program is; nothing: none was left. InvalidArgument: what was left is no servo of
/// this list.
Result<std::optional<CommissionMemory::HalfDone>> leftHalfDone(const CommissionRoundPlan &plan);


} // namespace dynascope
