// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/assignment.h"
#include "app/dxl/commands.h"

#include <optional>

namespace dynascope::dxl {

/// What was read back; nothing where the device lets nothing be read.
using Written = std::optional<Bytes>;

/// One write, verified. A change of ID or baud rate is followed. The journal has it.
Result<Written> writeOne(const Work &work, Device &device, const Assignment &assignment);

struct AssignedTo {
    Device *device = nullptr;
    const Assignment *assignment = nullptr; ///< isInRam()
};
/// One register of each device, all in one packet, so that joints set off together. Who doesn't show it afterwards is
/// written to alone, and so says why. An outcome for each; the journal has an entry for each.
std::vector<Result<Written>> writeTogether(const Work &work, const std::vector<AssignedTo> &all);

void showWritten(Output &output, Device &device, const Assignment &assignment, const Written &written);

} // namespace dynascope::dxl
