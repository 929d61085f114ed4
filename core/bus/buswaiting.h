// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

namespace dynascope {

/// What one exchange waits by.
struct Bus::Waiting {
    LineTime begin{};  ///< write start
    LineTime sent{};   ///< t0: when the last byte of the request has left
    LineTime origin{}; ///< from when the present deadline counts: t0, or the end of the predecessor's packet
    LineTime limit{};  ///< whatever comes, not longer than this
    LineTime lastByte{};
    int highestId = MaximumId;
    Collector::Found found;
};

} // namespace dynascope
