// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/assignment.h"

#include "app/dxl/directjob.h"
#include "app/dxl/showvalue.h"
#include "core/bus/messages.h"
#include "core/session/deviceplace.h"
#include "core/table/units.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// Where a device is changes with these.
constexpr const char16_t *PlaceFields[] = {u"ID", u"Baud Rate"};

Result<Assignment> prepareOne(Device &device, const RegisterArgument &argument)
{
    if (argument.isByAddress()) {
        auto data = parseRawValue(argument);
        if (!data)
            return tl::unexpected(data.error());
        const Field *baud = device.table() ? device.table()->find(u"Baud Rate") : nullptr;
        const int end = argument.address + static_cast<int>(data->size());
        if (baud && baud->address >= argument.address && baud->address < end && !device.bus().line().canSetBaudRate())
            return tl::unexpected(messages::deviceRateBound(device.bus().line().name()));
        const Field *known = device.table() ? device.table()->at(argument.address) : nullptr;
        if (!known || known->size != argument.length)
            return Assignment{argument, nullptr, 0, std::move(*data)};
        device.assume(*known, rawFromBytes(*known, *data));
        return Assignment{argument, known, rawFromBytes(*known, *data), std::move(*data)};
    }
    const auto field = device.field(argument.field);
    if (!field)
        return tl::unexpected(field.error());
    if (!(*field)->isWritable()) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("%1: %2 can only be read").arg(device.name(), (*field)->name));
    }
    const auto limits = device.limits(**field);
    if (!limits)
        return tl::unexpected(limits.error());
    const auto raw = parseValue(**field, *limits, device.table()->resolution(), argument.value);
    if (!raw)
        return tl::unexpected(raw.error());
    device.assume(**field, *raw); // so that it limits what is assigned after it
    return Assignment{argument, *field, *raw, bytesFromRaw(**field, *raw)};
}

/// A span that changes ID or baud rate among others would leave open where to look for the device.
Result<void> checkSpans(Device &device, const std::vector<Assignment> &assignments)
{
    for (const Assignment &assignment : assignments) {
        const RegisterArgument &span = assignment.argument;
        for (const char16_t *name : PlaceFields) {
            const Field *field = device.table() ? device.table()->find(name) : nullptr;
            if (!field || !span.isByAddress() || assignment.field == field || field->address < span.address
                || field->end() > span.address + span.length)
                continue;
            const auto written = rawFromBytes(
                *field, ByteView(assignment.data).subspan(static_cast<std::size_t>(field->address - span.address)));
            const auto present = device.read(*field);
            if (present && *present == written)
                continue;
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("%1 changes the %2 among others: write %3:%4 by itself; nothing was written")
                               .arg(span.text(), field->name)
                               .arg(field->address)
                               .arg(field->size));
        }
    }
    return {};
}

} // namespace

Result<std::vector<Assignment>> prepare(Device &device, const std::vector<RegisterArgument> &arguments)
{
    std::vector<Assignment> assignments;
    for (const RegisterArgument &argument : arguments) {
        auto assignment = prepareOne(device, argument);
        if (!assignment)
            return tl::unexpected(assignment.error());
        assignments.push_back(std::move(*assignment));
    }
    if (const auto clear = checkSpans(device, assignments); !clear)
        return tl::unexpected(clear.error());
    return assignments;
}

Result<void> checkTorque(Device &device, const std::vector<Assignment> &assignments)
{
    const Field *torque = device.table() ? device.table()->find(u"Torque Enable") : nullptr;
    if (!torque || std::ranges::none_of(assignments, &Assignment::isLockedByTorque))
        return {};
    const auto present = device.read(*torque);
    if (!present)
        return tl::unexpected(withWayOut(present.error(), device));
    bool on = *present != 0;
    for (const Assignment &assignment : assignments) {
        if (assignment.field == torque)
            on = assignment.raw != 0;
        else if (on && assignment.isLockedByTorque()) {
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("%1: %2 %3 while torque is on; write torque_enable=off first; nothing was "
                                          "written")
                               .arg(device.name(), assignment.field->name,
                                    assignment.field->torqueOff ? QStringLiteral("can't be written")
                                                                : QStringLiteral("is in the EEPROM area, which is locked")));
        }
    }
    return {};
}

} // namespace dynascope::dxl
