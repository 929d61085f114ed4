// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/protocol_values.h"
#include "core/sim/simulatedbus.h"

#include <QStringList>

namespace dynascope::sim {
namespace {

tl::unexpected<Error> wrong(QStringView entry, const QString &why)
{
    return failure(ErrorKind::InvalidArgument, QStringLiteral("\"%1\": %2").arg(entry.toString(), why));
}

Result<ServoSpec> parseOne(QStringView entry, const Catalog &catalog)
{
    const qsizetype colon = entry.lastIndexOf(u':');
    const qsizetype at = entry.lastIndexOf(u'@');
    if (at < 1 || colon < at)
        return wrong(entry, QStringLiteral("a device is written MODEL[/FIRMWARE]@BAUD:ID, as in XM430-W350@57600:1"));
    const QStringView device = entry.first(at);
    const qsizetype slash = device.lastIndexOf(u'/');
    const QStringView model = slash < 0 ? device : device.first(slash);
    const Catalog::ModelInfo *info = catalog.model(model);
    if (!info)
        return wrong(entry, QStringLiteral("no model is called %1").arg(model.toString()));
    ServoSpec spec;
    spec.model = info->model;
    bool ok = true;
    if (slash >= 0)
        spec.firmware = device.sliced(slash + 1).toInt(&ok);
    if (!ok || spec.firmware < -1 || spec.firmware > 255)
        return wrong(entry, QStringLiteral("the firmware is a number from 0 to 255"));
    spec.baudRate = entry.sliced(at + 1, colon - at - 1).toInt(&ok);
    const ControlTablePtr table = catalog.find(info->modelNumber, slash < 0 ? info->newestFirmware : spec.firmware);
    if (!table)
        return wrong(entry, QStringLiteral("no table of %1 is known for that firmware").arg(info->model));
    if (!ok || !table->baudCode(spec.baudRate)) {
        QStringList rates;
        for (const BaudCode &code : table->description().baudCodes)
            rates.append(QString::number(code.rate));
        return wrong(entry,
                     QStringLiteral("the rates of %1 are %2").arg(info->model, rates.join(QStringLiteral(", "))));
    }
    spec.id = entry.sliced(colon + 1).toInt(&ok);
    if (!ok || spec.id < 0 || spec.id > MaximumId)
        return wrong(entry, QStringLiteral("the ID is a number from 0 to %1").arg(MaximumId));
    return spec;
}

} // namespace

Result<std::vector<ServoSpec>> parseServoSpecs(QStringView text, const Catalog &catalog)
{
    std::vector<ServoSpec> specs;
    for (const QStringView entry : text.split(u',')) {
        const QStringView trimmed = entry.trimmed();
        if (trimmed.isEmpty())
            return failure(ErrorKind::InvalidArgument,
                           QStringLiteral("A device is missing in \"%1\"").arg(text.toString()));
        auto spec = parseOne(trimmed, catalog);
        if (!spec)
            return tl::unexpected(spec.error());
        specs.push_back(std::move(*spec));
    }
    return specs;
}

} // namespace dynascope::sim
