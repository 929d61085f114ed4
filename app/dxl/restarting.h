// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "app/dxl/device.h"
#include "core/session/procedures/procedures.h"

namespace dynascope::dxl {

/// Where the device is, once it is back from a restart; `took` is how long that was.
Result<Found> awaitReturn(Bus &bus, const DevicePlace &from, const DevicePlace &to, LineTime &took);

DevicePlace placeOf(const Device &device);

/// Asks whether to go on with `what`, unless --yes. The program may be started where nobody can be asked: then it is
/// refused. False: that, or no; it has been said.
bool mayGoOn(const Work &work, const QString &what);

QString idsText(const Options &options); ///< "device 1", "devices 1, 3"

} // namespace dynascope::dxl
