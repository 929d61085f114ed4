// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/device.h"
#include "app/dxl/output.h"

#include <optional>

namespace dynascope::dxl {

/// A register and what will be written to it.
struct Assignment {
    RegisterArgument argument;
    const Field *field = nullptr; ///< also where its address and length were given; nullptr: none known
    std::int64_t raw = 0;         ///< of the field
    Bytes data;

    bool isLockedByTorque() const { return !argument.isByAddress() && field->needsTorqueOff(); }
    bool isInRam() const { return field && field->area == Area::Ram; }
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

/// What was read back; nothing where the device lets nothing be read.
using Written = std::optional<Bytes>;

/// One write, verified. A change of ID or baud rate is followed.
Result<Written> writeOne(Device &device, const Assignment &assignment);

struct AssignedTo {
    Device *device = nullptr;
    const Assignment *assignment = nullptr; ///< isInRam()
};
/// One register of each device, all in one packet, so that joints set off together. Who doesn't show it afterwards is
/// written to alone, and so says why. An outcome for each.
std::vector<Result<Written>> writeTogether(Bus &bus, const std::vector<AssignedTo> &all);

void showWritten(Output &output, Device &device, const Assignment &assignment, const Written &written);

} // namespace dynascope::dxl
