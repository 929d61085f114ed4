// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"

#include <map>
#include <tuple>

namespace dynascope {

/// Our own numbers of devices. One that went and is found again where it was gets its former number, so that what
/// refers to it (traces, histories) goes on. GUI thread.
class DeviceKeys
{
public:
    /// For a device that was just found on this line. No two that are present have the same.
    DeviceKey take(const QString &line, const Found &found);
    /// `device` is about to go from this line.
    void release(const QString &line, const Device &device);

private:
    using Place = std::tuple<QString, int, int, int, int>; ///< line, baud rate, ID, model number, firmware

    std::map<Place, DeviceKey> m_former;
    DeviceKey m_next = 1;
};

} // namespace dynascope
