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

/// After a change of ID or baud rate the device answers elsewhere: such writes are procedures, which look for it there.
Result<void> move(Device &device, const Assignment &assignment)
{
    DirectJob job(device.bus());
    const DevicePlace place = placeOf(device.found(), *device.table(), device.name());
    Result<Found> found;
    if (normalizedName(assignment.field->name) == u"id") {
        found = changeId(job, {place, static_cast<std::uint8_t>(assignment.raw), assignment.field->address, false});
    } else {
        const int rate = device.table()->baudRate(static_cast<int>(assignment.raw)).value(); // moves() has looked
        const auto code = static_cast<std::uint8_t>(assignment.raw);
        found = changeBaud(job, {place, rate, code, assignment.field->address, false});
    }
    return found ? device.follow(*found) : Result<void>(tl::unexpected(found.error()));
}

bool moves(Device &device, const Assignment &assignment)
{
    if (!assignment.field)
        return false;
    const bool isId = assignment.field == device.table()->find(u"ID");
    if (!isId && assignment.field != device.table()->find(u"Baud Rate"))
        return false;
    // By address also what the table doesn't know may be sent; it leads to no place that one could look at.
    if (isId ? assignment.raw > MaximumId : !device.table()->baudRate(static_cast<int>(assignment.raw)))
        return false;
    const auto present = device.read(*assignment.field);
    return !present || *present != assignment.raw;
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

Result<Written> writeOne(Device &device, const Assignment &assignment)
{
    const SpanData data = assignment.to(device);
    if (moves(device, assignment)) {
        if (const auto moved = move(device, assignment); !moved)
            return tl::unexpected(moved.error());
        return device.read(data.address, static_cast<int>(data.data.size()));
    }
    if (assignment.field)
        device.learn(*assignment.field, assignment.raw);
    if (!device.isMute())
        return writeVerified(device.bus(), data);
    const auto sent = write(device.bus(), data);
    return sent ? Result<Written>(std::nullopt) : tl::unexpected(sent.error());
}

std::vector<Result<Written>> writeTogether(Bus &bus, const std::vector<AssignedTo> &all)
{
    std::vector<SpanData> writes;
    std::vector<Span> spans;
    std::vector<std::size_t> readable; ///< of `all`
    for (std::size_t i = 0; i < all.size(); ++i) {
        const AssignedTo &one = all[i];
        writes.push_back(one.assignment->to(*one.device));
        one.device->learn(*one.assignment->field, one.assignment->raw);
        if (one.device->isMute())
            continue;
        readable.push_back(i);
        spans.push_back({writes[i].id, writes[i].address, static_cast<std::uint16_t>(writes[i].data.size())});
    }
    if (const auto sent = writeMany(bus, writes); !sent)
        return std::vector<Result<Written>>(all.size(), tl::unexpected(sent.error()));
    std::vector<Result<Written>> outcomes(all.size(), Written());
    const auto shown = readMany(bus, spans);
    for (std::size_t place = 0; place < readable.size(); ++place) {
        const std::size_t i = readable[place];
        if (shown && (*shown)[place] && (*shown)[place]->data == writes[i].data)
            outcomes[i] = writes[i].data;
        else
            outcomes[i] = writeVerified(bus, writes[i]);
    }
    return outcomes;
}

void showWritten(Output &output, Device &device, const Assignment &assignment, const Written &written)
{
    if (!written)
        showSent(output, device, assignment.field, assignment.argument, assignment.data);
    else if (assignment.argument.isByAddress())
        showBytes(output, device, assignment.argument, *written);
    else
        showField(output, device, *assignment.field, rawFromBytes(*assignment.field, *written));
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
                           QStringLiteral("%1: %2 is in the EEPROM area, which is locked while torque is on; write "
                                          "torque_enable=off first; nothing was written")
                               .arg(device.name(), assignment.field->name));
        }
    }
    return {};
}

} // namespace dynascope::dxl
