// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/movedevices.h"

#include "core/bus/messages.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

bool isSilence(const Error &error)
{
    return error.kind == ErrorKind::NothingReceived;
}

DevicePlace at(const MoveDevice &device, const MovePlace &place)
{
    DevicePlace there = device.place;
    there.id = static_cast<std::uint8_t>(place.id);
    there.baudRate = place.baudRate;
    return there;
}

Result<void> tryRates(Bus &bus, const MovePlan &plan)
{
    std::set<int> rates;
    for (std::size_t i = plan.next; i < plan.steps.size(); ++i)
        rates.insert({plan.steps[i].from.baudRate, plan.steps[i].to.baudRate});
    for (const int rate : rates) {
        if (rate == bus.line().baudRate())
            continue;
        if (!bus.line().canSetBaudRate())
            return tl::unexpected(messages::deviceRateBound(bus.line().name()));
        const AtBaud there(bus, rate);
        if (!there.entered())
            return failure(there.entered().error().kind,
                           ProcedureText::tr("%1; nothing was written").arg(there.entered().error().text));
    }
    return {};
}

Result<bool> isAtPlace(JobContext &context, const MoveDevice &device, const MovePlace &place)
{
    const auto found = look(context, at(device, place));
    if (found)
        return found->modelNumber == device.place.modelNumber && found->firmware == device.firmware;
    if (isSilence(found.error()))
        return false;
    return tl::unexpected(found.error());
}

/// Was the begun step done before the program ended?
Result<void> findBegun(JobContext &context, MovePlan &plan)
{
    if (plan.isOver())
        return {};
    const MoveStep &step = plan.steps[plan.next];
    const MoveDevice &device = plan.devices[step.device];
    const auto there = isAtPlace(context, device, step.to);
    if (!there)
        return tl::unexpected(there.error());
    const auto here = isAtPlace(context, device, step.from);
    if (!here)
        return tl::unexpected(here.error());
    if (*there && !*here)
        ++plan.next;
    return {};
}

Result<void> checkPresent(JobContext &context, const MovePlan &plan)
{
    for (std::size_t i = 0; i < plan.devices.size(); ++i) {
        const bool isConcerned =
            std::ranges::any_of(plan.steps, [i](const MoveStep &step) { return step.device == i; });
        if (!isConcerned)
            continue;
        if (const auto go = context.checkpoint(); !go)
            return go;
        const MovePlace place = plan.placeOf(i);
        const auto there = isAtPlace(context, plan.devices[i], place);
        if (!there)
            return tl::unexpected(there.error());
        if (!*there) {
            return failure(ErrorKind::NotFound,
                           ProcedureText::tr("%1 does not answer as %2, or another device does; nothing was written")
                               .arg(plan.devices[i].place.name, placeText(place)));
        }
    }
    return {};
}

/// Of the places to come, those that none of the plan's own devices has now.
Result<void> checkFree(JobContext &context, const MovePlan &plan)
{
    std::set<MovePlace> known, wanted;
    for (std::size_t i = 0; i < plan.devices.size(); ++i)
        known.insert(plan.placeOf(i));
    for (std::size_t i = plan.next; i < plan.steps.size(); ++i) {
        if (!known.contains(plan.steps[i].to))
            wanted.insert(plan.steps[i].to);
    }
    for (const MovePlace &place : wanted) {
        if (const auto go = context.checkpoint(); !go)
            return go;
        const AtBaud there(context.bus(), place.baudRate);
        if (!there.entered())
            return there.entered();
        const auto answer = context.bus().exchange(pingRequest(static_cast<std::uint8_t>(place.id)), 0);
        if (!answer)
            return tl::unexpected(answer.error());
        const auto &reply = answer->replies.front();
        // Noise is looked into when its turn comes.
        if (reply || reply.error().kind == ErrorKind::DamagedCrc || reply.error().kind == ErrorKind::Refused) {
            return failure(
                ErrorKind::InvalidArgument,
                ProcedureText::tr("%1 is taken: something answers there; nothing was written").arg(placeText(place)));
        }
    }
    return {};
}

Result<Found> carryOut(JobContext &context, const MovePlan &plan, const MoveStep &step)
{
    const MoveDevice &device = plan.devices[step.device];
    const DevicePlace from = at(device, step.from);
    if (!step.isBaud()) {
        return changeId(context, {from, static_cast<std::uint8_t>(step.to.id), device.idAddress, plan.turnTorqueOff});
    }
    const auto rate =
        std::ranges::find_if(device.rates, [&](const auto &each) { return each.first == step.to.baudRate; });
    if (rate == device.rates.end())
        return failure(ErrorKind::InvalidArgument,
                       ProcedureText::tr("%1 does not offer %2 bps").arg(device.place.name).arg(step.to.baudRate));
    return changeBaud(context, {from, step.to.baudRate, static_cast<std::uint8_t>(rate->second), device.baudAddress,
                                plan.turnTorqueOff});
}

} // namespace

Result<void> checkMoves(JobContext &context, MovePlan &plan)
{
    if (const auto able = tryRates(context.bus(), plan); !able)
        return able;
    if (const auto found = findBegun(context, plan); !found)
        return found;
    if (const auto present = checkPresent(context, plan); !present)
        return present;
    return checkFree(context, plan);
}

Result<MoveSurvey> surveyMoves(JobContext &context, const MoveSurveyPlan &plan)
{
    MoveSurvey survey;
    Bus &bus = context.bus();
    survey.rates.insert(bus.line().baudRate());
    for (const int rate : plan.rates) {
        if (const auto go = context.checkpoint(); !go)
            return tl::unexpected(go.error());
        if (rate == bus.line().baudRate() || !bus.line().canSetBaudRate())
            continue;
        const AtBaud there(bus, rate);
        if (there.entered())
            survey.rates.insert(rate);
        else if (there.entered().error().kind != ErrorKind::PortUnsuitable)
            return tl::unexpected(there.entered().error());
    }
    for (const MoveSurveyPlan::Secondary &each : plan.secondaries) {
        if (const auto go = context.checkpoint(); !go)
            return tl::unexpected(go.error());
        const AtBaud there(context.bus(), each.place.baudRate);
        if (!there.entered())
            return tl::unexpected(there.entered().error());
        const auto raw = read(context.bus(), {each.place.id, each.address, 1});
        if (!raw && !isSilence(raw.error()) && raw.error().kind != ErrorKind::Refused) {
            return failure(raw.error().kind, ProcedureText::tr("The Secondary ID of %1 could not be read: %2")
                                                 .arg(each.place.name, raw.error().text));
        }
        survey.secondaries.push_back(raw ? std::optional<int>(raw->data.front()) : std::nullopt);
    }
    return survey;
}

Result<Found> moveOne(JobContext &context, MovePlan &plan, const MoveHooks &hooks)
{
    if (const auto saved = hooks.save ? hooks.save(plan) : Result<void>(); !saved)
        return tl::unexpected(saved.error());
    const MoveStep &step = plan.steps[plan.next];
    if (hooks.begun)
        hooks.begun(step);
    auto found = carryOut(context, plan, step);
    if (hooks.ended)
        hooks.ended(step, found);
    if (found)
        ++plan.next;
    return found;
}

Result<void> moveDevices(JobContext &context, MovePlan &plan, const MoveHooks &hooks)
{
    while (!plan.isOver()) {
        if (const auto go = context.checkpoint(); !go)
            return go;
        if (const auto moved = moveOne(context, plan, hooks); !moved)
            return tl::unexpected(moved.error());
    }
    return hooks.save ? hooks.save(plan) : Result<void>();
}

} // namespace dynascope
