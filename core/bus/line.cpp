// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/line.h"

#include "core/bus/messages.h"

namespace dynascope {

Result<void> Line::lowerLatency()
{
    return tl::unexpected(messages::noLatencyTimer(name()));
}

} // namespace dynascope
