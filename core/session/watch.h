// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"

#include <compare>

namespace dynascope {

/// A field of a device that is read all the time.
struct Watch {
    DeviceKey device = 0;
    int field = 0; ///< index in its table

    friend auto operator<=>(const Watch &, const Watch &) = default;
};

} // namespace dynascope
