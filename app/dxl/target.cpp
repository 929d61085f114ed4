// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/target.h"

#include "app/dxl/showvalue.h"
#include "core/bus/operations.h"

namespace dynascope::dxl {

void showDeviceFailure(const Work &work, std::uint8_t id, const Error &error)
{
    Document document;
    work.output.failedResult(document.add("id", qint64(id)).add("error", error.text));
    work.output.fail(error);
}

Targets findTargets(const Work &work, std::size_t results, bool blind)
{
    const std::vector<std::uint8_t> &ids = work.options.idList;
    if (results > 1)
        work.output.expectMany();
    if (ids.size() > 1)
        work.output.expectDevices();
    Targets targets;
    for (const std::uint8_t id : ids) {
        Device &device = targets.devices.emplace_back(work.bus, id);
        if (blind)
            continue;
        const auto known = device.identify(work.catalog);
        if (known)
            continue;
        targets.devices.pop_back();
        targets.code = ExitCode::Failed;
        targets.ended = endsAll(known.error());
        showDeviceFailure(work, id, targets.ended ? known.error() : withAdvice(known.error(), work.options));
        if (targets.ended)
            break;
    }
    return targets;
}

ExitCode forEachDevice(const Work &work, const std::function<Result<void>(Device &)> &action,
                       const std::function<Result<void>(const std::deque<Device> &)> &before)
{
    Targets targets = findTargets(work, 1);
    if (const auto may = before ? before(targets.devices) : Result<void>(); !may)
        return work.output.refuse(may.error());
    for (Device &device : targets.devices) {
        if (targets.ended || work.output.isClosed())
            break;
        Result<void> done = device.enter();
        if (done)
            done = action(device);
        if (done)
            continue;
        const Error error = withWayOut(done.error(), device);
        showDeviceFailure(work, device.id(), error);
        const bool sent = error.kind == ErrorKind::NotConfirmed && targets.code != ExitCode::Failed;
        targets.code = sent ? ExitCode::Unconfirmed : ExitCode::Failed;
        targets.ended = endsAll(error);
    }
    return targets.code;
}

} // namespace dynascope::dxl
