// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/pace.h"
#include "core/bus/poller.h"

#include <functional>

namespace dynascope::dxl {

/// Polls as often as `pace` says, until its time is over or `goesOn` says no; `take` gets each batch as it comes. An error
/// is the line's.
Result<void> pollPaced(Bus &bus, PollPlan plan, Pace pace, const std::function<bool()> &goesOn,
                       const std::function<void(const Batch &)> &take);

} // namespace dynascope::dxl
