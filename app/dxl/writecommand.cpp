// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/device.h"
#include "app/dxl/directjob.h"
#include "app/dxl/showvalue.h"
#include "core/bus/messages.h"
#include "core/session/procedures/procedures.h"
#include "core/table/units.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// A register and what will be written to it.
struct Assignment {
    RegisterArgument argument;
    const Field *field = nullptr; ///< nullptr where an address was given
    std::int64_t raw = 0;         ///< of the field
    Bytes data;
};

Result<Assignment> prepare(Device &device, const RegisterArgument &argument)
{
    if (argument.isByAddress()) {
        auto data = parseRawValue(argument);
        if (!data)
            return tl::unexpected(data.error());
        const Field *baud = device.table() ? device.table()->find(u"Baud Rate") : nullptr;
        const int end = argument.address + static_cast<int>(data->size());
        if (baud && baud->address >= argument.address && baud->address < end && !device.bus().line().canSetBaudRate())
            return tl::unexpected(messages::deviceRateBound(device.bus().line().name()));
        return Assignment{argument, nullptr, 0, std::move(*data)};
    }
    const auto field = device.field(argument.field);
    if (!field)
        return tl::unexpected(field.error());
    if (!(*field)->isWritable()) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("%1: %2 can only be read").arg(device.name(), (*field)->name));
    }
    const auto raw = parseValue(**field, device.limits(**field), device.table()->resolution(), argument.value);
    if (!raw)
        return tl::unexpected(raw.error());
    device.learn(**field, *raw); // so that it limits what is assigned after it
    return Assignment{argument, *field, *raw, bytesFromRaw(**field, *raw)};
}

DevicePlace placeOf(const Device &device)
{
    const Field *torque = device.table()->find(u"Torque Enable");
    return {device.id(), device.bus().line().baudRate(), device.modelNumber(),
            torque ? torque->address : std::uint16_t(0), device.name()};
}

/// After a change of ID or baud rate the device answers elsewhere: such writes are procedures, which look for it there.
Result<void> move(Device &device, const Assignment &assignment)
{
    DirectJob job(device.bus());
    Result<Found> found;
    if (normalizedName(assignment.field->name) == u"id") {
        found = changeId(job, {placeOf(device), static_cast<std::uint8_t>(assignment.raw), assignment.field->address, false});
    } else {
        const auto rate = device.table()->baudRate(static_cast<int>(assignment.raw));
        if (!rate) {
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("%1 has no baud rate with the code %2").arg(device.name()).arg(assignment.raw));
        }
        found = changeBaud(job, {placeOf(device), *rate, static_cast<std::uint8_t>(assignment.raw),
                                 assignment.field->address, false});
    }
    return found ? device.follow(*found) : Result<void>(tl::unexpected(found.error()));
}

bool moves(Device &device, const Assignment &assignment)
{
    if (!assignment.field)
        return false;
    const QString name = normalizedName(assignment.field->name);
    if (name != u"id" && name != u"baudrate")
        return false;
    const auto present = device.read(*assignment.field);
    return present && *present != assignment.raw;
}

/// One write, verified and printed as it was read back.
Result<void> writeOne(Output &output, Device &device, const Assignment &assignment)
{
    if (moves(device, assignment)) {
        const auto moved = move(device, assignment);
        if (!moved)
            return moved;
        showField(output, device, *assignment.field, assignment.raw);
        return {};
    }
    const int address = assignment.field ? assignment.field->address : assignment.argument.address;
    if (assignment.field)
        device.learn(*assignment.field, assignment.raw);
    const auto back = writeVerified(device.bus(), {device.id(), static_cast<std::uint16_t>(address), assignment.data});
    if (!back)
        return tl::unexpected(back.error());
    if (assignment.field)
        showField(output, device, *assignment.field, rawFromBytes(*assignment.field, *back));
    else
        showBytes(output, device, assignment.argument, *back);
    return {};
}

/// EEPROM is locked under torque: refused before the first write, not in the middle of several.
Result<void> checkTorque(Device &device, const std::vector<Assignment> &assignments)
{
    const Field *torque = device.table()->find(u"Torque Enable");
    const auto locked = [](const Assignment &assignment) {
        return assignment.field && assignment.field->needsTorqueOff();
    };
    if (!torque || std::ranges::none_of(assignments, locked))
        return {};
    const auto present = device.read(*torque);
    if (!present)
        return tl::unexpected(present.error());
    bool on = *present != 0;
    for (const Assignment &assignment : assignments) {
        if (assignment.field == torque)
            on = assignment.raw != 0;
        else if (on && locked(assignment)) {
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("%1: %2 is in the EEPROM area, which is locked while torque is on; write "
                                          "torque_enable=off first; nothing was written")
                               .arg(device.name(), assignment.field->name));
        }
    }
    return {};
}

} // namespace

ExitCode writeCommand(const Work &work)
{
    const std::vector<RegisterArgument> &registers = work.options.registers;
    if (registers.size() > 1)
        work.output.expectMany();
    Device device(work.bus, work.options.id);
    if (const auto known = device.identify(work.catalog); !known)
        return work.output.fail(withAdvice(known.error(), work.options));
    std::vector<Assignment> assignments;
    for (const RegisterArgument &argument : registers) {
        auto assignment = prepare(device, argument);
        if (!assignment)
            return work.output.refuse(assignment.error()); // nothing has been written
        assignments.push_back(std::move(*assignment));
    }
    if (const auto free = checkTorque(device, assignments); !free)
        return work.output.fail(free.error());
    device.forget();
    for (const Assignment &assignment : assignments) {
        if (const auto done = writeOne(work.output, device, assignment); !done)
            return showFailure(work.output, device, assignment.argument, done.error());
    }
    return ExitCode::Done;
}

} // namespace dynascope::dxl
