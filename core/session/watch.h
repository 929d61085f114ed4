// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

#include <compare>

namespace dynascope {

/// A field of a device that is read all the time.
struct Watch {
    quint32 device = 0; ///< DeviceKey
    int field = 0;      ///< index in its table

    friend auto operator<=>(const Watch &, const Watch &) = default;
};

} // namespace dynascope
