// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "core/bus/operations.h"

namespace dynascope::dxl {

ExitCode pingCommand(const Work &work)
{
    const auto reply = ping(work.bus, work.options.id);
    if (!reply)
        return work.output.fail(withAdvice(reply.error(), work.options));
    const QString model = modelName(work.catalog, reply->modelNumber);
    Document document;
    document.add("id", qint64(reply->id))
        .add("model", model)
        .add("model_number", qint64(reply->modelNumber))
        .add("firmware", qint64(reply->firmware))
        .addFlag("alert", reply->alert);
    work.output.result(QStringLiteral("ID %1: %2 (model %3), firmware %4%5")
                           .arg(reply->id)
                           .arg(model)
                           .arg(reply->modelNumber)
                           .arg(reply->firmware)
                           .arg(reply->alert ? QStringLiteral(", alert: see Hardware Error Status") : QString()),
                       document);
    return ExitCode::Done;
}

} // namespace dynascope::dxl
