// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/target.h"
#include "core/bus/operations.h"

namespace dynascope::dxl {

namespace {

void show(const Work &work, const PingReply &reply)
{
    const QString model = modelName(work.catalog, reply.modelNumber);
    Document document;
    document.add("id", qint64(reply.id))
        .add("model", model)
        .add("model_number", qint64(reply.modelNumber))
        .add("firmware", qint64(reply.firmware))
        .addFlag("alert", reply.alert);
    work.output.result(QStringLiteral("ID %1: %2 (model %3), firmware %4%5")
                           .arg(reply.id)
                           .arg(model)
                           .arg(reply.modelNumber)
                           .arg(reply.firmware)
                           .arg(reply.alert ? QStringLiteral(", alert: see Hardware Error Status") : QString()),
                       document);
}

} // namespace

ExitCode pingCommand(const Work &work)
{
    if (work.options.idList.size() > 1)
        work.output.expectMany();
    ExitCode code = ExitCode::Done;
    for (const std::uint8_t id : work.options.idList) {
        const auto reply = ping(work.bus, id);
        if (reply) {
            show(work, *reply);
            continue;
        }
        code = ExitCode::Failed;
        showDeviceFailure(work, id, withAdvice(reply.error(), work.options));
        if (endsAll(reply.error()))
            break;
    }
    return code;
}

} // namespace dynascope::dxl
