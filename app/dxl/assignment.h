// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/device.h"
#include "core/session/procedures/procedures.h"

namespace dynascope::dxl {

/// A register and what will be written to it.
struct Assignment {
    RegisterArgument argument;
    const Field *field = nullptr; ///< also where its address and length were given; nullptr: none known
    std::int64_t raw = 0;         ///< of the field
    Bytes data;

    bool isLockedByTorque() const { return !argument.isByAddress() && field->needsTorqueOff(); }
    bool isInRam() const { return field && field->area == Area::Ram && becomesLater(*field, raw).empty(); }
    SpanData to(const Device &device) const
    {
        const int address = field ? field->address : argument.address;
        return {device.id(), static_cast<std::uint16_t>(address), data};
    }
};

/// What is to be written, all of it checked against the table; InvalidArgument: nothing may be written.
Result<std::vector<Assignment>> prepare(Device &device, const std::vector<RegisterArgument> &arguments);

/// EEPROM is locked under torque: refused before the first write, not in the middle of several.
Result<void> checkTorque(Device &device, const std::vector<Assignment> &assignments);

} // namespace dynascope::dxl
