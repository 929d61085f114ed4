// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace dynascope {

class Device;

/// `what` is said of a device that does not answer; with it who else on its line has lately, which tells a dead device
/// from a dead line. GUI thread.
QString withNeighbours(const Device &device, const QString &what);

} // namespace dynascope
