// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/assignment.h"
#include "app/dxl/commands.h"
#include "core/session/settings/settingsplan.h"

namespace dynascope::dxl {

/// `write --explain`: what each assignment would bring besides its value, the earlier ones being done. Writes nothing.
ExitCode explainWrites(const Work &work, Device &device, const std::vector<Assignment> &assignments);

/// `write --safely`: all assignments in their right order, what a mode resets put back, torque off where that is needed;
/// on again only with `--torque-back`, or where the assignments say so, and with the goal at rest.
Result<SettingsPlan> planSafely(const Work &work, const Device &device, const std::vector<Assignment> &assignments);
ExitCode writeSafely(const Work &work, Device &device, const SettingsPlan &plan);

} // namespace dynascope::dxl
