// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/assignment.h"
#include "app/dxl/commands.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"

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

/// The failure that ends all, if there was one.
Result<void> writeAll(const Work &work, Device &device, const std::vector<Assignment> &assignments, ExitCode &code)
{
    if (const auto there = device.enter(); !there)
        return there;
    device.forget();
    for (std::size_t i = 0; i < assignments.size(); ++i) {
        const auto written = writeOne(work, device, assignments[i]);
        if (!written) {
            code =
                showFailure(work.output, device, assignments[i].argument, written.error(), doneBefore(assignments, i));
            return endsAll(written.error()) ? Result<void>(tl::unexpected(written.error())) : Result<void>();
        }
        if (*written == Written::Sent && code == ExitCode::Done)
            code = ExitCode::Unconfirmed;
    }
    return {};
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

} // namespace

ExitCode writeCommand(const Work &work)
{
    Targets targets = findTargets(work, work.options.registers.size());
    if (!targets.areAll()) {
        if (work.options.idList.size() > 1)
            work.output.note(QStringLiteral("nothing was written, since not everybody answered"));
        return targets.code;
    }
    std::vector<std::vector<Assignment>> assignments;
    for (Device &device : targets.devices) {
        auto prepared = prepare(device, work.options.registers);
        if (!prepared)
            return work.output.refuse({prepared.error().kind, work.output.named(device.id(), prepared.error().text)});
        if (targets.devices.size() > 1) {
            if (const auto alone = checkId(device, *prepared); !alone)
                return work.output.refuse(alone.error());
        }
        if (const auto free = checkTorque(device, *prepared); !free)
            return work.output.fail(free.error());
        assignments.push_back(std::move(*prepared));
    }
    ExitCode code = ExitCode::Done;
    for (std::size_t i = 0; i < assignments.size(); ++i) {
        if (!writeAll(work, targets.devices[i], assignments[i], code))
            break;
    }
    return code;
}

} // namespace dynascope::dxl
