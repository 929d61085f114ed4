// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of ID and baud rate, and Factory Reset: after them the device stands elsewhere.
#include "core/bus/messages.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/procedures/procedures.h"

#include <QCoreApplication>

#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

QString tr(const char *text)
{
    return QCoreApplication::translate("Procedures", text);
}

/// EEPROM is locked under torque: turn it off where allowed, else refuse.
Result<void> freeEeprom(Bus &bus, const DevicePlace &place, bool turnTorqueOff)
{
    const auto torque = read(bus, {place.id, place.torqueAddress, 1});
    if (!torque)
        return tl::unexpected(torque.error());
    if (torque->data.front() == 0)
        return {};
    if (!turnTorqueOff) {
        return failure(ErrorKind::InvalidArgument,
                       tr("%1 is under torque, which locks its EEPROM; nothing was written").arg(place.name));
    }
    const auto off = writeVerified(bus, {place.id, place.torqueAddress, {0}});
    return off ? Result<void>() : tl::unexpected(off.error());
}

/// The model that answers there, if one does. Noise counts as somebody: the place isn't free.
Result<std::optional<Found>> whoIsAt(Bus &bus, std::uint8_t id)
{
    const auto reply = ping(bus, id);
    if (reply)
        return Found{id, bus.line().baudRate(), reply->modelNumber, reply->firmware, reply->alert, {}};
    if (reply.error().kind == ErrorKind::NothingReceived)
        return std::nullopt;
    return tl::unexpected(reply.error());
}

bool isThere(const Result<std::optional<Found>> &who, std::uint16_t modelNumber)
{
    return who && *who && (*who)->modelNumber == modelNumber;
}

/// EEPROM writes take up to tens of milliseconds and their status may come from either place: never sent twice.
Result<void> writeOnce(Bus &bus, const SpanData &data)
{
    const auto result = bus.exchange(writeRequest(data), 0);
    if (!result)
        return tl::unexpected(result.error());
    const auto &reply = result->replies.front();
    if (!reply && reply.error().kind == ErrorKind::Refused)
        return tl::unexpected(reply.error());
    return bus.settle(2ms, 100ms); // whatever else came of it is looked up, not believed
}

/// Where the rate is somebody else's, even the one we were told may not be true: no device is moved away from it.
Result<void> rateIsOurs(Bus &bus)
{
    if (bus.line().canSetBaudRate())
        return {};
    return tl::unexpected(messages::deviceRateBound(bus.line().name()));
}

} // namespace

Result<Found> changeId(JobContext &context, const ChangeIdPlan &plan)
{
    Bus &bus = context.bus();
    const DevicePlace &place = plan.place;
    const AtBaud there(bus, place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());

    const auto taken = whoIsAt(bus, plan.newId);
    if (!taken || *taken) {
        return failure(ErrorKind::InvalidArgument,
                       tr("ID %1 is taken: something answers there; nothing was written").arg(plan.newId));
    }
    if (const auto free = freeEeprom(bus, place, plan.turnTorqueOff); !free)
        return tl::unexpected(free.error());
    if (const auto go = context.checkpoint(); !go)
        return tl::unexpected(go.error());

    const JobContext::Exclusive exclusive(context);
    if (const auto sent = writeOnce(bus, {place.id, plan.idAddress, {plan.newId}}); !sent)
        return tl::unexpected(sent.error());
    const auto now = whoIsAt(bus, plan.newId);
    if (isThere(now, place.modelNumber))
        return **now;
    if (!now && now.error().kind == ErrorKind::Stopped)
        return tl::unexpected(now.error());
    if (isThere(whoIsAt(bus, place.id), place.modelNumber)) {
        return failure(ErrorKind::NotConfirmed,
                       tr("%1 still answers at ID %2: it did not take the new ID").arg(place.name).arg(place.id));
    }
    return failure(ErrorKind::NotConfirmed,
                   tr("%1 answers neither at ID %2 nor at ID %3 after the change; scan to find it")
                       .arg(place.name)
                       .arg(plan.newId)
                       .arg(place.id));
}

Result<Found> changeBaud(JobContext &context, const ChangeBaudPlan &plan)
{
    Bus &bus = context.bus();
    const DevicePlace &place = plan.place;
    if (const auto ours = rateIsOurs(bus); !ours)
        return tl::unexpected(ours.error());
    const AtBaud there(bus, place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    {
        // Tried, not believed: a device at a rate the port can't do would be lost to it.
        const AtBaud attempt(bus, plan.newBaudRate);
        if (!attempt.entered()) {
            return failure(ErrorKind::PortUnsuitable,
                           tr("%1; nothing was written").arg(attempt.entered().error().text));
        }
        const auto taken = whoIsAt(bus, place.id);
        if (!taken || *taken) {
            return failure(ErrorKind::InvalidArgument,
                           tr("ID %1 is taken at %2 bps: something answers there; nothing was written")
                               .arg(place.id)
                               .arg(plan.newBaudRate));
        }
    }
    if (const auto free = freeEeprom(bus, place, plan.turnTorqueOff); !free)
        return tl::unexpected(free.error());
    if (const auto go = context.checkpoint(); !go)
        return tl::unexpected(go.error());

    const JobContext::Exclusive exclusive(context);
    if (const auto sent = writeOnce(bus, {place.id, plan.baudAddress, {plan.code}}); !sent)
        return tl::unexpected(sent.error());
    {
        const AtBaud moved(bus, plan.newBaudRate);
        const auto now = whoIsAt(bus, place.id);
        if (isThere(now, place.modelNumber))
            return **now;
        if (!now && now.error().kind == ErrorKind::Stopped)
            return tl::unexpected(now.error());
    }
    if (isThere(whoIsAt(bus, place.id), place.modelNumber)) {
        return failure(ErrorKind::NotConfirmed, tr("%1 still answers at %2 bps: it did not take the new baud rate")
                                                    .arg(place.name)
                                                    .arg(place.baudRate));
    }
    return failure(ErrorKind::NotConfirmed,
                   tr("%1 answers neither at %2 bps nor at %3 bps after the change; scan to find it")
                       .arg(place.name)
                       .arg(plan.newBaudRate)
                       .arg(place.baudRate));
}

Result<void> resetToFactory(JobContext &context, const FactoryResetPlan &plan)
{
    Bus &bus = context.bus();
    if (const auto ours = rateIsOurs(bus); !ours && plan.option != ResetOption::AllButIdAndBaud)
        return ours;
    const bool moves = plan.after.id != plan.place.id || plan.after.baudRate != plan.place.baudRate;
    if (moves) {
        const AtBaud after(bus, plan.after.baudRate);
        if (!after.entered())
            return after.entered();
        const auto taken = whoIsAt(bus, plan.after.id);
        if (!taken || *taken) {
            return failure(ErrorKind::InvalidArgument,
                           tr("ID %1 at %2 bps, where the reset would put it, is taken; nothing was written")
                               .arg(plan.after.id)
                               .arg(plan.after.baudRate));
        }
    }
    const AtBaud there(bus, plan.place.baudRate);
    if (!there.entered())
        return there.entered();
    const JobContext::Exclusive exclusive(context);
    const auto sent = factoryReset(bus, plan.place.id, plan.option);
    // Its status may be lost in the reboot that follows; the look afterwards decides.
    const auto lost = [](ErrorKind kind) {
        return kind == ErrorKind::NothingReceived || kind == ErrorKind::CutOff || kind == ErrorKind::NoHeader
            || kind == ErrorKind::DamagedCrc;
    };
    if (!sent && !lost(sent.error().kind))
        return sent;
    if (!sent && !moves) {
        return failure(ErrorKind::NotConfirmed,
                       tr("%1 did not confirm the reset, and would stand at the same place either way; read its registers to "
                          "see whether it took it")
                           .arg(plan.place.name));
    }
    return {};
}

} // namespace dynascope
