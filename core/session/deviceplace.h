// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/procedures.h"
#include "core/table/controltable.h"

namespace dynascope {

class Device;

/// Where a device is that was found there and has this table, for procedures.
DevicePlace placeOf(const Found &found, const ControlTable &table, const QString &name);
DevicePlace placeOf(const Device &device);

} // namespace dynascope
