// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/deviceplace.h"

#include "core/session/linesession.h"

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

MoveDevice moveDevice(const Found &found, const ControlTable &table, const QString &name)
{
    MoveDevice device = moveDevice(found, name);
    device.place = placeOf(found, table, name);
    if (const Field *id = table.find(Known::Id))
        device.idAddress = id->address;
    if (const Field *baud = table.find(Known::BaudRate))
        device.baudAddress = baud->address;
    for (const BaudCode &code : table.description().baudCodes)
        device.rates.emplace_back(code.rate, code.code);
    return device;
}

MoveDevice moveDevice(const Found &found, const QString &name)
{
    MoveDevice device;
    device.place.id = found.id;
    device.place.baudRate = found.baudRate;
    device.place.modelNumber = found.modelNumber;
    device.place.name = name;
    device.firmware = found.firmware;
    device.goal = {found.baudRate, found.id};
    return device;
}

DevicePlace placeAfterReset(const Device &device, ResetOption option)
{
    DevicePlace place = placeOf(device);
    const Field *id = device.table().find(Known::Id);
    const Field *baud = device.table().find(Known::BaudRate);
    if (option == ResetOption::All)
        place.id = static_cast<std::uint8_t>(id ? id->initial.value_or(1) : 1);
    if (option != ResetOption::AllButIdAndBaud) {
        const auto code = static_cast<int>(baud ? baud->initial.value_or(1) : 1);
        place.baudRate = device.table().baudRate(code).value_or(57600);
    }
    return place;
}

IdHolder holderOf(const Device &device, int id, std::optional<int> baudRate)
{
    if (!device.line())
        return {};
    for (const auto &other : device.line()->devices()) {
        if (other.get() == &device || other->baudRate() != baudRate.value_or(device.baudRate()))
            continue;
        if (other->id() == id)
            return {other.get(), false};
        if (other->raw(Known::SecondaryId) == id)
            return {other.get(), true};
    }
    return {};
}

} // namespace dynascope
