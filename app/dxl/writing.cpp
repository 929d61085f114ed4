// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/writing.h"

#include "app/dxl/directjob.h"
#include "app/dxl/noting.h"
#include "app/dxl/showvalue.h"
#include "core/bus/operations.h"
#include "core/session/deviceplace.h"

#include <set>

namespace dynascope::dxl {

namespace {

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

/// With what it replaces, and what it resets besides: noted before, should nobody live to note it behind.
std::vector<RegisterChange> withOld(Device &device, const Assignment &assignment, RegisterChange change,
                                    const std::vector<PollValue> &before)
{
    JournalEntry entry;
    if (change.before.empty())
        change.before = bytesIn(before, change.address, change.after.size());
    entry.changes = {std::move(change)};
    if (assignment.field && !before.empty())
        addResets(entry, *device.table(), *assignment.field,
                  [&before](const Field &other) { return bytesIn(before, other.address, other.size); });
    return std::move(entry.changes);
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
Result<Bytes> writeNoted(const Work &work, Device &device, const Assignment &assignment, const RegisterChange &change,
                         const std::vector<const Field *> &affected)
{
    WriteFieldPlan plan;
    plan.place.baudRate = device.found().baudRate;
    plan.data = {device.id(), change.address, change.after};
    if (device.table())
        plan.sideEffects = spansOf(*device.table(), device.id(), among(affected));
    if (assignment.field)
        plan.becomes = becomesLater(*assignment.field, assignment.raw);
    plan.before = plan.sideEffects;
    if (change.before.empty())
        plan.before.push_back({device.id(), change.address, static_cast<std::uint16_t>(change.after.size())});
    DirectJob job(device.bus());
    std::vector<RegisterChange> changes{change};
    if (assignment.field && !assignment.field->resets.isEmpty()) {
        if (const auto values = readSpans(job, {plan.place, plan.before}))
            changes = withOld(device, assignment, change, *values);
    }
    JournalNote note = noteWrite(work, device, std::move(changes), affected);
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

void noteSent(JournalNote &note, const Result<void> &sent)
{
    JournalEntry outcome = note.entry();
    outcome.state = sent ? JournalState::Unconfirmed : stateAfter(sent.error());
    outcome.note = sent ? QString() : sent.error().text;
    note.finish(outcome);
}

/// Nothing can be read of a device that answers Ping alone.
Result<void> sendNoted(const Work &work, const Device &device, const RegisterChange &change)
{
    JournalNote note = noteWrite(work, device, {change});
    const auto sent = write(device.bus(), {device.id(), change.address, change.after});
    noteSent(note, sent);
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

/// What is asked of one of several devices that are written to at once.
struct Share {
    JournalNote note; ///< once what it replaces has been read
    SpanData data;
    std::vector<const Field *> affected;
    std::vector<Span> spans; ///< the register itself, then what else may change; none of a device that is mute
};

Share shareOf(const AssignedTo &one)
{
    Device &device = *one.device;
    const Assignment &assignment = *one.assignment;
    Share share{{}, assignment.to(device), affectedBy(device, assignment), {}};
    device.learn(*assignment.field, assignment.raw);
    if (device.isMute())
        return share;
    share.spans.push_back({share.data.id, share.data.address, static_cast<std::uint16_t>(share.data.data.size())});
    for (const Span &span : spansOf(*device.table(), device.id(), among(share.affected)))
        share.spans.push_back(span);
    return share;
}

PollValue valueAt(std::uint16_t address, Bytes data)
{
    PollValue value;
    value.address = address;
    value.length = static_cast<std::uint16_t>(data.size());
    value.data = std::move(data);
    return value;
}

/// What can't be read is missing. For each share, in their order.
std::vector<std::vector<PollValue>> readShares(Bus &bus, const std::vector<Share> &shares)
{
    std::vector<Span> spans;
    for (const Share &share : shares)
        spans.insert(spans.end(), share.spans.begin(), share.spans.end());
    const auto replies = spans.empty() ? Result<std::vector<Result<ReadReply>>>() : readMany(bus, spans);
    std::vector<std::vector<PollValue>> values(shares.size());
    if (!replies)
        return values;
    std::size_t at = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        for (const Span &span : shares[i].spans) {
            const Result<ReadReply> &reply = (*replies)[at++];
            if (reply)
                values[i].push_back(valueAt(span.address, reply->data));
        }
    }
    return values;
}

/// The register itself comes first where it was read.
bool shows(const std::vector<PollValue> &values, const SpanData &data)
{
    return !values.empty() && values.front().address == data.address && values.front().data == data.data;
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
            const auto sent = sendNoted(work, device, change);
            return sent ? Result<Written>(std::nullopt) : tl::unexpected(sent.error());
        }
        back = writeNoted(work, device, assignment, change, affected);
    }
    return back ? Result<Written>(std::move(*back)) : tl::unexpected(back.error());
}

std::vector<Result<Written>> writeTogether(const Work &work, const std::vector<AssignedTo> &all)
{
    std::vector<Share> shares;
    std::vector<SpanData> writes;
    for (const AssignedTo &one : all) {
        shares.push_back(shareOf(one));
        writes.push_back(shares.back().data);
    }
    const auto before = readShares(work.bus, shares);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        Device &device = *all[i].device;
        const Assignment &assignment = *all[i].assignment;
        shares[i].note = noteWrite(work, device, withOld(device, assignment, changeOf(assignment), before[i]),
                                   shares[i].affected);
    }
    if (const auto sent = writeMany(work.bus, writes); !sent) {
        for (std::size_t i = 0; i < shares.size(); ++i)
            shares[i].note.failed(sent.error(), before[i]);
        return std::vector<Result<Written>>(all.size(), tl::unexpected(sent.error()));
    }
    const auto after = readShares(work.bus, shares);
    std::vector<Result<Written>> outcomes;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        Share &share = shares[i];
        if (share.spans.empty()) {
            noteSent(share.note, {});
            outcomes.emplace_back(std::nullopt);
            continue;
        }
        std::vector<PollValue> values = after[i];
        if (!shows(values, share.data)) {
            const auto alone = writeVerified(work.bus, share.data);
            if (!alone) {
                share.note.failed(alone.error(), before[i]);
                outcomes.push_back(tl::unexpected(alone.error()));
                continue;
            }
            values.insert(values.begin(), valueAt(share.data.address, *alone));
        }
        share.note.done(before[i], values);
        outcomes.emplace_back(share.data.data);
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

} // namespace dynascope::dxl
