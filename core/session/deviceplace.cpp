// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/deviceplace.h"

#include "core/session/device.h"

namespace dynascope {

DevicePlace placeOf(const Found &found, const ControlTable &table, const QString &name)
{
    DevicePlace place;
    place.id = found.id;
    place.baudRate = found.baudRate;
    place.modelNumber = found.modelNumber;
    place.name = name;
    if (const Field *torque = table.find(Known::TorqueEnable))
        place.torqueAddress = torque->address;
    return place;
}

DevicePlace placeOf(const Device &device)
{
    return placeOf(device.found(), device.table(), device.displayName());
}

} // namespace dynascope
