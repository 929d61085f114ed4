// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/assignment.h"

#include "app/dxl/directjob.h"
#include "app/dxl/noting.h"
#include "app/dxl/showvalue.h"
#include "core/bus/messages.h"
#include "core/session/deviceplace.h"
#include "core/table/units.h"

#include <algorithm>
#include <set>

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
    const auto raw = parseValue(**field, device.limits(**field), device.table()->resolution(), argument.value);
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

namespace {

RegisterChange changeOf(const Assignment &assignment)
{
    if (assignment.field)
        return dynascope::changeOf(*assignment.field, assignment.data);
    return {{}, static_cast<std::uint16_t>(assignment.argument.address), false, {}, assignment.data, {}};
}

/// Registers that the span covers, and what else they may change.
std::vector<const Field *> affectedBy(Device &device, const Assignment &assignment)
{
    if (assignment.field)
        return affectedBy(device, *assignment.field);
    std::set<const Field *> all;
    const int begin = assignment.argument.address, end = begin + static_cast<int>(assignment.data.size());
    for (const Field &field : device.table() ? device.table()->fields() : std::span<const Field>()) {
        if (!field.isWritable() || field.address >= end || field.end() <= begin)
            continue;
        for (const Field *other : affectedBy(device, field)) {
            if (other->address >= end || other->end() <= begin) // the span itself is noted as it is
                all.insert(other);
        }
    }
    return {all.begin(), all.end()};
}

/// ID or baud rate.
Result<Bytes> moveNoted(const Work &work, Device &device, const Assignment &assignment)
{
    RegisterChange change = changeOf(assignment);
    if (const auto old = device.read(*assignment.field))
        change.before = bytesFromRaw(*assignment.field, *old);
    JournalNote note = noteWrite(work, device, {std::move(change)});
    if (const auto moved = move(device, assignment); !moved) {
        note.failed(moved.error());
        return tl::unexpected(moved.error());
    }
    note.moved(device.found());
    return device.read(assignment.field->address, assignment.field->size);
}

/// Its own old value is in `change` where that can't be read any more.
Result<Bytes> writeNoted(const Work &work, Device &device, const RegisterChange &change,
                         const std::vector<const Field *> &affected)
{
    WriteFieldPlan plan;
    plan.place.baudRate = device.found().baudRate;
    plan.data = {device.id(), change.address, change.after};
    if (device.table()) {
        plan.sideEffects = spansOf(*device.table(), device.id(), [&affected](const Field &field) {
            return std::ranges::find(affected, &field) != affected.end();
        });
    }
    plan.before = plan.sideEffects;
    if (change.before.empty())
        plan.before.push_back({device.id(), change.address, static_cast<std::uint16_t>(change.after.size())});
    JournalNote note = noteWrite(work, device, {change}, affected);
    DirectJob job(device.bus());
    const auto written = writeField(job, plan);
    const auto before = written ? written->before : std::vector<PollValue>();
    const auto after = written ? written->after : tl::unexpected(written.error());
    if (!after) {
        note.failed(after.error(), before);
        return tl::unexpected(after.error());
    }
    note.done(before, *after);
    return after->front().data;
}

/// Nothing can be read of a device that answers Ping alone.
Result<void> sendNoted(const Work &work, const Device &device, const RegisterChange &change)
{
    JournalNote note = noteWrite(work, device, {change});
    const auto sent = write(device.bus(), {device.id(), change.address, change.after});
    JournalEntry outcome = note.entry();
    outcome.state = sent ? JournalState::Unconfirmed : stateAfter(sent.error());
    outcome.note = sent ? QString() : sent.error().text;
    note.finish(outcome);
    return sent;
}

/// With the old value of what decides whether anything can be read afterwards.
RegisterChange changeNow(Device &device, const Assignment &assignment)
{
    RegisterChange change = changeOf(assignment);
    const Field *level = device.table() ? device.table()->find(Known::StatusReturnLevel) : nullptr;
    if (level && assignment.field == level && !device.isMute()) {
        if (const auto old = device.read(*level))
            change.before = bytesFromRaw(*level, *old);
    }
    return change;
}

} // namespace

Result<Written> writeOne(const Work &work, Device &device, const Assignment &assignment)
{
    Result<Bytes> back;
    if (moves(device, assignment)) {
        back = moveNoted(work, device, assignment);
    } else {
        const RegisterChange change = changeNow(device, assignment);
        const auto affected = affectedBy(device, assignment);
        if (assignment.field)
            device.learn(*assignment.field, assignment.raw);
        if (device.isMute()) {
            if (const auto sent = sendNoted(work, device, change); !sent)
                return tl::unexpected(sent.error());
            showSent(work.output, device, assignment.field, assignment.argument, assignment.data);
            return Written::Sent;
        }
        back = writeNoted(work, device, change, affected);
    }
    if (!back)
        return tl::unexpected(back.error());
    if (assignment.argument.isByAddress())
        showBytes(work.output, device, assignment.argument, *back);
    else
        showField(work.output, device, *assignment.field, rawFromBytes(*assignment.field, *back));
    return Written::ReadBack;
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
