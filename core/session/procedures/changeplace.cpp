// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of ID and baud rate, and Factory Reset: after them the device stands elsewhere.
#include "core/bus/messages.h"
#include "core/bus/operations.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/procedures/procedures.h"
#include "core/session/texts.h"

#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

/// EEPROM is locked under torque: turn it off where allowed, else refuse.
Result<void> freeEeprom(Bus &bus, const DevicePlace &place, bool turnTorqueOff)
{
    const auto torque = read(bus, {place.id, place.torqueAddress, 1});
    if (!torque)
        return tl::unexpected(torque.error());
    if (torque->data.front() == 0)
        return {};
    if (!turnTorqueOff) {
        return failure(
            ErrorKind::InvalidArgument,
            ProcedureText::tr("%1 is under torque, which locks its EEPROM; nothing was written").arg(place.name));
    }
    const auto off = writeVerified(bus, {place.id, place.torqueAddress, {0}});
    return off ? Result<void>() : tl::unexpected(off.error());
}

QString placeText(std::uint8_t id, int baudRate)
{
    return ProcedureText::tr("ID %1 at %2 bps").arg(id).arg(baudRate);
}

QString placeText(const DevicePlace &place)
{
    return placeText(place.id, place.baudRate);
}

/// Says that nobody was heard there, but not that nobody is: another one's answer, or what may be an earlier one's.
bool isInconclusive(const Error &error)
{
    return error.kind == ErrorKind::NotSent || error.kind == ErrorKind::LateAnswer || error.kind == ErrorKind::WrongId;
}

/// Bytes that only somebody at that place, or a second voice there, can have sent. Noise counts as somebody.
bool isSomebody(const Error &error)
{
    switch (error.kind) {
    case ErrorKind::NoHeader:
    case ErrorKind::CutOff:
    case ErrorKind::DamagedCrc:
    case ErrorKind::WrongLength:
    case ErrorKind::Refused: return true;
    default: return false;
    }
}

/// Tried, not believed: a device at a rate that the port can't do would be lost to it. `known` is a device that
/// answers: that it does proves that nothing older is under way which could be mistaken for somebody at `place`.
Result<void> checkFree(JobContext &context, const DevicePlace &place, const DevicePlace &known)
{
    constexpr int Attempts = 3;
    Bus &bus = context.bus();
    const AtBaud there(bus, place.baudRate);
    if (!there.entered() && there.entered().error().kind == ErrorKind::PortUnsuitable) {
        return failure(ErrorKind::PortUnsuitable,
                       ProcedureText::tr("%1; nothing was written").arg(there.entered().error().text));
    }
    if (!there.entered())
        return there.entered();
    auto reply = ping(bus, place.id);
    for (int attempt = 1; attempt < Attempts && !reply && isInconclusive(reply.error()); ++attempt) {
        if (const auto waited = bus.wait(20ms); !waited)
            return waited;
        if (const auto asked = look(context, known); !asked && endsAll(asked.error()))
            return tl::unexpected(asked.error());
        reply = ping(bus, place.id);
    }
    if (!reply && reply.error().kind == ErrorKind::NothingReceived)
        return {};
    if (!reply && endsAll(reply.error()))
        return tl::unexpected(reply.error());
    if (!reply && !isSomebody(reply.error()))
        return failure(reply.error().kind, ProcedureText::tr("%1; nothing was written").arg(reply.error().text));
    return failure(
        ErrorKind::InvalidArgument,
        ProcedureText::tr("%1 is taken: something answers there; nothing was written").arg(placeText(place)));
}

/// EEPROM writes take up to tens of milliseconds and their status may come from either place: never sent twice.
Result<void> writeOnce(Bus &bus, const SpanData &data)
{
    const auto result = bus.exchange(writeRequest(data), 0);
    if (!result)
        return tl::unexpected(result.error());
    const auto &reply = result->replies.front();
    if (!reply && !mayHaveArrived(reply.error()))
        return tl::unexpected(reply.error());
    return bus.wait(2ms); // whatever else came of it is looked up, not believed
}

/// One register is written and the device stands elsewhere, or still where it was.
Result<Found> changePlace(JobContext &context, const DevicePlace &from, const DevicePlace &to, const SpanData &data,
                          bool turnTorqueOff)
{
    Bus &bus = context.bus();
    const AtBaud there(bus, from.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    if (const auto free = checkFree(context, to, from); !free)
        return tl::unexpected(free.error());
    if (const auto free = freeEeprom(bus, from, turnTorqueOff); !free)
        return tl::unexpected(free.error());
    if (const auto go = context.checkpoint(); !go)
        return tl::unexpected(go.error());

    const JobContext::Exclusive exclusive(context);
    if (const auto sent = writeOnce(bus, data); !sent)
        return tl::unexpected(sent.error());
    auto found = lookForMoved(context, from, to);
    if (found && isAt(*found, from))
        return failure(
            ErrorKind::NotConfirmed,
            ProcedureText::tr("%1 still answers at %2: it did not take the change").arg(from.name, placeText(from)));
    return found;
}

/// Where the rate is somebody else's, even the one we were told may not be true: no device is moved away from it.
Result<void> rateIsOurs(Bus &bus)
{
    if (bus.line().canSetBaudRate())
        return {};
    return tl::unexpected(messages::deviceRateBound(bus.line().name()));
}

} // namespace

bool isAt(const Found &found, const DevicePlace &place)
{
    return found.id == place.id && found.baudRate == place.baudRate;
}

Result<Found> lookForMoved(JobContext &context, const DevicePlace &from, const DevicePlace &to)
{
    const bool moves = to.id != from.id || to.baudRate != from.baudRate;
    for (const DevicePlace &place : moves ? std::vector{to, from} : std::vector{to}) {
        auto found = look(context, place);
        if (found ? found->modelNumber == from.modelNumber : endsAll(found.error()))
            return found;
    }
    if (!moves) {
        return failure(ErrorKind::NotConfirmed,
                       ProcedureText::tr("%1 does not answer at %2; scan to find it").arg(from.name, placeText(to)));
    }
    return failure(ErrorKind::NotConfirmed,
                   ProcedureText::tr("%1 answers neither at %2 nor at %3; scan to find it")
                       .arg(from.name, placeText(to), placeText(from)));
}

Result<Found> changeId(JobContext &context, const ChangeIdPlan &plan)
{
    DevicePlace to = plan.place;
    to.id = plan.newId;
    return changePlace(context, plan.place, to, {plan.place.id, plan.idAddress, {plan.newId}}, plan.turnTorqueOff);
}

Result<Found> changeBaud(JobContext &context, const ChangeBaudPlan &plan)
{
    if (const auto ours = rateIsOurs(context.bus()); !ours)
        return tl::unexpected(ours.error());
    DevicePlace to = plan.place;
    to.baudRate = plan.newBaudRate;
    return changePlace(context, plan.place, to, {plan.place.id, plan.baudAddress, {plan.code}}, plan.turnTorqueOff);
}

Result<void> resetToFactory(JobContext &context, const FactoryResetPlan &plan)
{
    Bus &bus = context.bus();
    if (const auto ours = rateIsOurs(bus); !ours && plan.option != ResetOption::AllButIdAndBaud)
        return ours;
    const bool moves = plan.after.id != plan.place.id || plan.after.baudRate != plan.place.baudRate;
    if (moves) {
        if (const auto free = checkFree(context, plan.after, plan.place); !free)
            return free;
    }
    const AtBaud there(bus, plan.place.baudRate);
    if (!there.entered())
        return there.entered();
    const JobContext::Exclusive exclusive(context);
    const auto sent = factoryReset(bus, plan.place.id, plan.option);
    // Its status may be lost in the reboot that follows; the look afterwards decides.
    if (!sent && !mayHaveArrived(sent.error()))
        return sent;
    if (!sent && !moves) {
        return failure(
            ErrorKind::NotConfirmed,
            ProcedureText::tr(
                "%1 did not confirm the reset, and would stand at the same place either way; read its registers to "
                "see whether it took it")
                .arg(plan.place.name));
    }
    return {};
}

} // namespace dynascope
