// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/procedures.h"

#include "core/bus/asking.h"
#include "core/session/procedures/atbaud.h"
#include "core/table/controltable.h"

namespace dynascope {
namespace {

Result<PollValue> readValue(Bus &bus, const Span &span)
{
    auto reply = read(bus, span);
    if (!reply)
        return tl::unexpected(reply.error());
    PollValue value;
    value.address = span.address;
    value.data = std::move(reply->data);
    value.alert = reply->alert;
    value.at = reply->at;
    return value;
}

/// Appends what the spans hold; a refusal of one leaves it out.
Result<void> appendSpans(JobContext &context, const std::vector<Span> &spans, std::vector<PollValue> &values)
{
    for (const Span &span : spans) {
        if (const auto go = context.checkpoint(); !go)
            return go;
        auto value = readValue(context.bus(), span);
        if (value)
            values.push_back(std::move(*value));
        else if (value.error().kind != ErrorKind::Refused)
            return tl::unexpected(value.error());
    }
    return {};
}

} // namespace

Result<std::vector<PollValue>> readSpans(JobContext &context, const ReadSpansPlan &plan)
{
    const AtBaud there(context.bus(), plan.place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    std::vector<PollValue> values;
    if (const auto all = appendSpans(context, plan.spans, values); !all)
        return tl::unexpected(all.error());
    return values;
}

namespace {

/// What can't be read is left out; an end of all is the error.
Result<std::vector<PollValue>> readBefore(JobContext &context, const std::vector<Span> &spans)
{
    std::vector<PollValue> values;
    const auto all = appendSpans(context, spans, values);
    if (!all && !mayHaveArrived(all.error()) && all.error().kind != ErrorKind::NotSent)
        return tl::unexpected(all.error());
    return values;
}

Result<std::vector<PollValue>> writeAndRead(JobContext &context, const WriteFieldPlan &plan)
{
    const Asking asking(context.bus(), plan.leavesOnlyPing);
    const auto length = static_cast<std::uint16_t>(plan.data.data.size());
    auto written = writeVerified(context.bus(), plan.data);
    const bool isSilent = !written && written.error().kind == ErrorKind::NothingReceived;
    if (isSilent && plan.leavesOnlyPing && ping(context.bus(), plan.data.id))
        written = plan.data.data; // Ping is answered and no Read: it does as it was told
    if (!written && !plan.becomes.empty()) {
        const auto now = readValue(context.bus(), {plan.data.id, plan.data.address, length});
        if (now && now->data == plan.becomes)
            written = plan.becomes;
    }
    if (!written)
        return tl::unexpected(written.error());
    PollValue readBack;
    readBack.address = plan.data.address;
    readBack.data = std::move(*written);
    readBack.at = context.bus().line().now();
    std::vector<PollValue> values{std::move(readBack)};
    // The write itself is done and verified: what else it moved is told as far as it could be read.
    if (const auto all = appendSpans(context, plan.sideEffects, values);
        !all && all.error().kind == ErrorKind::PortLost)
        return tl::unexpected(all.error());
    return values;
}

} // namespace

bool isBeyondLimit(const Error &error)
{
    return error.kind == ErrorKind::Refused
           && (error.number == static_cast<std::uint8_t>(DeviceError::DataLimit)
               || error.number == static_cast<std::uint8_t>(DeviceError::DataRange));
}

Bytes becomesLater(const Field &field, std::int64_t raw)
{
    constexpr std::int64_t Save = 1, Saved = 2;
    return field.name == u"Hybrid Save" && raw == Save ? bytesFromRaw(field, Saved) : Bytes();
}

Result<WrittenField> writeField(JobContext &context, const WriteFieldPlan &plan)
{
    const AtBaud there(context.bus(), plan.place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    auto before = readBefore(context, plan.before);
    if (!before)
        return tl::unexpected(before.error());
    return WrittenField{std::move(*before), writeAndRead(context, plan)};
}

Result<std::vector<WrittenField>> setTorque(JobContext &context, int baudRate, const std::vector<TorqueEntry> &entries,
                                            bool on)
{
    const AtBaud there(context.bus(), baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    std::vector<WrittenField> outcomes;
    for (const TorqueEntry &entry : entries) {
        if (const auto go = context.checkpoint(); !go)
            return tl::unexpected(go.error());
        WriteFieldPlan plan;
        plan.data = {entry.id, entry.address, {std::uint8_t(on ? 1 : 0)}};
        std::vector<PollValue> before;
        if (on) {
            plan.sideEffects = entry.affected;
            auto read = readBefore(context, entry.affected);
            if (!read)
                return tl::unexpected(read.error());
            before = std::move(*read);
        }
        outcomes.push_back({std::move(before), writeAndRead(context, plan)});
    }
    return outcomes;
}

Result<Found> look(JobContext &context, const DevicePlace &place)
{
    const AtBaud there(context.bus(), place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    const auto reply = ping(context.bus(), place.id);
    if (!reply)
        return tl::unexpected(reply.error());
    return Found{place.id, place.baudRate, reply->modelNumber, reply->firmware, reply->alert, {}};
}

Result<void> atPlace(JobContext &context, const DevicePlace &place, const std::function<Result<void>(Bus &)> &operation)
{
    const AtBaud there(context.bus(), place.baudRate);
    if (!there.entered())
        return there.entered();
    return operation(context.bus());
}

} // namespace dynascope
