// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "core/session/indirectpacking.h"

#include <map>
#include <set>

namespace dynascope {

/// What one device is polled for.
struct DeviceWatches {
    const Device *device = nullptr;
    std::vector<int> fields;  ///< indices of its table; at full rate where `rates` says nothing else
    bool isSelected = false;  ///< its RAM is on screen: 10 Hz
    std::set<int> unfolded = {}; ///< fields of long runs (indirect.h) that are on screen, too
    std::set<int> signs = {};    ///< read at least each 10 s, whatever else is
    std::map<int, double> rates = {}; ///< of `fields`: Hz
    const IndirectPacking *packing = nullptr; ///< what of `fields` is at full rate, and in it, is read by it
    std::set<int> glance = {}; ///< read five times a second, whatever else is
    std::set<int> once = {};   ///< read until they are known
};

/// How long between two readings at this rate; 0: it is every cycle's.
std::chrono::milliseconds intervalOf(double hertz);

/// The spans to poll. Pure. Fields that touch are one span; which gaps are read through the bus knows (chooseReads);
/// besides what is watched and selected, every device's state (torque, hardware error, voltage, temperature) at 1 Hz, and
/// Return Delay Time and Status Return Level until they are known.
/// Devices that are rebooting or at another rate than `baudRate`, the line's, are left out; of these the bus learns how
/// they answer. Long runs of like registers (indirect blocks, histories) are polled only where they are unfolded.
PollPlan planWatches(const std::vector<DeviceWatches> &devices, int baudRate);

} // namespace dynascope
