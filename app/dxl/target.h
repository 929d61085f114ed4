// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "app/dxl/device.h"

namespace dynascope::dxl {

/// What reading and writing registers begin with: a result for each of them, and the device by its Ping, unless all
/// registers are given by address and `onlyIfNamed`. Nothing where it doesn't answer, which has been said then.
std::optional<Device> target(const Work &work, bool onlyIfNamed);

} // namespace dynascope::dxl
