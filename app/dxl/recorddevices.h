// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "core/bus/poll_values.h"
#include "core/record/recording_values.h"

namespace dynascope::dxl {

/// What `dxl record` reads, and what the recording says of it. A device's key is its ID.
struct RecordPlan {
    RecordingHeader header;
    PollPlan poll;
};

/// Looks for the devices, reads the control table of each, and plans the reading. Failures have been said.
tl::expected<RecordPlan, ExitCode> planRecord(const Work &work);

} // namespace dynascope::dxl
