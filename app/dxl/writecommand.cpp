// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/safewrite.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "app/dxl/writing.h"
#include "core/bus/operations.h"
#include "core/session/groupwrite.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// What became of the assignments before the one that failed.
QString doneBefore(const std::vector<Assignment> &assignments, std::size_t failed)
{
    if (assignments.size() < 2)
        return {};
    QStringList names;
    for (std::size_t i = 0; i < failed; ++i)
        names << assignments[i].argument.text();
    return names.isEmpty() ? QStringLiteral("; nothing was written before it")
                           : QStringLiteral("; written before it: %1").arg(names.join(QStringLiteral(", ")));
}

/// What is written to one device, and what came of it.
struct Writing {
    Device *device = nullptr;
    std::vector<Assignment> assignments;
    std::vector<Result<Written>> outcomes; ///< as many as were tried; after a failure none

    bool isGoingOn() const { return outcomes.empty() || outcomes.back().has_value(); }
};

/// Prints one outcome; the failure that ends all, if it was one.
Result<void> show(const Work &work, const Writing &writing, std::size_t i, ExitCode &code)
{
    const Assignment &assignment = writing.assignments[i];
    const Result<Written> &outcome = writing.outcomes[i];
    if (outcome) {
        showWritten(work.output, *writing.device, assignment, *outcome);
        if (!*outcome && code == ExitCode::Done)
            code = ExitCode::Unconfirmed;
        return {};
    }
    code = showFailure(work.output, *writing.device, assignment.argument, outcome.error(),
                       doneBefore(writing.assignments, i));
    return endsAll(outcome.error()) ? Result<void>(tl::unexpected(outcome.error())) : Result<void>();
}

/// The failure that ends all, if there was one.
Result<void> writeAll(const Work &work, Writing &writing, ExitCode &code)
{
    if (const auto there = writing.device->enter(); !there)
        return there;
    writing.device->forget();
    for (std::size_t i = 0; i < writing.assignments.size() && writing.isGoingOn(); ++i) {
        writing.outcomes.push_back(writeOne(work, *writing.device, writing.assignments[i]));
        if (const auto shown = show(work, writing, i, code); !shown)
            return shown;
    }
    return {};
}

/// Register after register to all devices, then printed device after device.
ExitCode writeAtOnce(const Work &work, std::vector<Writing> &writings)
{
    for (Writing &writing : writings)
        writing.device->forget();
    for (std::size_t i = 0; i < work.options.registers.size(); ++i) {
        std::vector<Writing *> going;
        std::vector<AssignedTo> assigned;
        for (Writing &writing : writings) {
            if (!writing.isGoingOn())
                continue;
            going.push_back(&writing);
            assigned.push_back({writing.device, &writing.assignments[i]});
        }
        const auto outcomes = writeTogether(work, assigned);
        for (std::size_t place = 0; place < going.size(); ++place)
            going[place]->outcomes.push_back(outcomes[place]);
    }
    ExitCode code = ExitCode::Done;
    for (const Writing &writing : writings) {
        for (std::size_t i = 0; i < writing.outcomes.size(); ++i)
            (void)show(work, writing, i, code);
    }
    return code;
}

/// Is it about a device, not about what was asked?
bool isOfTheLine(const Error &error)
{
    switch (error.kind) {
    case ErrorKind::InvalidArgument:
    case ErrorKind::NotFound:
    case ErrorKind::NotSupported:
    case ErrorKind::PortUnsuitable: return false;
    default: return true;
    }
}

ExitCode refuse(const Work &work, const Device &device, const Error &error)
{
    const Error named{error.kind, work.output.named(device.id(), error.text)};
    if (!isOfTheLine(error))
        return work.output.refuse(named);
    return work.output.fail({named.kind, named.text + QStringLiteral("; nothing was written")});
}

/// Only one device can have an ID.
Result<void> checkId(Device &device, const std::vector<Assignment> &assignments)
{
    const Field *id = device.table() ? device.table()->find(Known::Id) : nullptr;
    const bool writesId = std::ranges::any_of(
        assignments, [&](const Assignment &one) { return id && one.field == id && one.raw != device.id(); });
    if (!writesId)
        return {};
    return failure(ErrorKind::InvalidArgument,
                   QStringLiteral("several devices can't get the same ID: write it to one alone; nothing was written"));
}

ExitCode explainAll(const Work &work, std::vector<Writing> &writings)
{
    work.output.expectMany();
    ExitCode code = ExitCode::Done;
    for (Writing &writing : writings) {
        const ExitCode one = explainWrites(work, *writing.device, writing.assignments);
        code = code == ExitCode::Done ? one : code;
    }
    return code;
}

/// One device after the other; planned for all before the first write.
ExitCode writeAllSafely(const Work &work, std::vector<Writing> &writings)
{
    work.output.expectMany();
    std::vector<SettingsPlan> plans;
    for (const Writing &writing : writings) {
        auto plan = planSafely(work, *writing.device, writing.assignments);
        if (!plan)
            return work.output.refuse(plan.error());
        plans.push_back(std::move(*plan));
    }
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < writings.size() && !work.bus.isCancelled() && !work.bus.lost(); ++i) {
        const ExitCode one = writeSafely(work, *writings[i].device, plans[i]);
        code = code == ExitCode::Done ? one : code;
    }
    return code;
}

/// An address may be another register on another model or firmware.
Result<void> checkAddresses(const Work &work, const Targets &targets)
{
    std::vector<GroupMember> members;
    for (const Device &device : targets.devices)
        members.push_back({device.id(), device.table(), device.name()});
    for (const RegisterArgument &argument : work.options.registers) {
        if (!argument.isByAddress())
            continue;
        if (const auto same = checkSameMeaning(members, argument.address, argument.length); !same)
            return same;
    }
    return {};
}

} // namespace

ExitCode writeCommand(const Work &work)
{
    Targets targets = findTargets(work, work.options.registers.size());
    if (!targets.areAll()) {
        if (work.options.idList.size() > 1)
            work.output.note(QStringLiteral("nothing was written, since not everybody answered"));
        return targets.code;
    }
    if (const auto same = checkAddresses(work, targets); !same)
        return work.output.refuse(same.error());
    std::vector<Writing> writings;
    for (Device &device : targets.devices) {
        auto prepared = prepare(device, work.options.registers);
        if (!prepared)
            return refuse(work, device, prepared.error());
        if (targets.devices.size() > 1) {
            if (const auto alone = checkId(device, *prepared); !alone)
                return work.output.refuse(alone.error());
        }
        const bool isOther = work.options.explain || work.options.safely; // torque is no obstacle to these
        if (const auto free = isOther ? Result<void>() : checkTorque(device, *prepared); !free)
            return work.output.fail(free.error());
        writings.push_back({&device, std::move(*prepared), {}});
    }
    if (work.options.explain)
        return explainAll(work, writings);
    if (work.options.safely)
        return writeAllSafely(work, writings);
    // EEPROM takes its time and may move a device: there each is heard out before the next.
    const bool inRam = std::ranges::all_of(writings, [](const Writing &one) {
        return std::ranges::all_of(one.assignments, &Assignment::isInRam);
    });
    if (writings.size() > 1 && inRam)
        return writeAtOnce(work, writings);
    ExitCode code = ExitCode::Done;
    for (Writing &writing : writings) {
        if (!writeAll(work, writing, code))
            break;
    }
    return code;
}

} // namespace dynascope::dxl
