// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

namespace dynascope {

/// Full-rate cycles a second that the wire allows for this plan: bytes at `baudRate`, the Return Delay Times that the
/// devices have, and the time they take to think, with nothing added by adapter or host; what is read at intervals takes
/// its part. 0 where that can't be told: nothing is read at full rate, the rest leaves no time for it, or a device's
/// Return Delay Time isn't known yet. Pure. Manual: "Protocol 2.0", status packets and Return Delay Time.
double possibleCycleRate(const PollPlan &plan, int baudRate);

} // namespace dynascope
