// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/output.h"
#include "core/session/profile/profileapply.h"

/// A profile's comparison and what was written for it, as text and JSON.
namespace dynascope::dxl {

/// A joint and, of its registers, those that aren't as wanted; `all`: every one of them in the JSON.
void showJoint(Output &output, const Profile &profile, const JointComparison &joint, bool namesRegisters, bool all);
void showOther(Output &output, const Catalog &catalog, const Found &found);
/// "j1: Shutdown: 0 (None) -> 52 (Overload)": what apply would write, or has written.
void showPlanned(Output &output, const JointApply &joint, const JointComparison &comparison);
void showApplied(Output &output, const JointApply &joint, const Result<SettingsOutcome> &outcome);

} // namespace dynascope::dxl
