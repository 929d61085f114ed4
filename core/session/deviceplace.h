// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"
#include "core/table/controltable.h"

namespace dynascope {

class Device;

/// Where a device is that was found there and has this table, for procedures.
DevicePlace placeOf(const Found &found, const ControlTable &table, const QString &name);
DevicePlace placeOf(const Device &device);

/// As a plan of moves has it, at home where it is.
MoveDevice moveDevice(const Found &found, const ControlTable &table, const QString &name);
/// The same of a model whose table nobody knows: others may move around it, it stays.
MoveDevice moveDevice(const Found &found, const QString &name);

/// Where a Factory Reset leaves the device: its table's defaults for what the option doesn't keep.
DevicePlace placeAfterReset(const Device &device, ResetOption option);

/// Another device of the line that answers to an ID.
struct IdHolder {
    const Device *device = nullptr; ///< none: the ID is free
    bool isSecondary = false;       ///< by its Secondary ID
};
/// Who answers to `id` at a baud rate, the device's own where none is given; itself left out.
IdHolder holderOf(const Device &device, int id, std::optional<int> baudRate = {});

} // namespace dynascope
