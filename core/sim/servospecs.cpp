// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/protocol_values.h"
#include "core/sim/servospec.h"

#include <QStringList>

namespace dynascope::sim {
namespace {

tl::unexpected<Error> wrongSpec(QStringView entry, const QString &why)
{
    return failure(ErrorKind::InvalidArgument, QStringLiteral("\"%1\": %2").arg(entry.toString(), why));
}

bool isId(int id)
{
    return id >= 0 && id <= MaximumId;
}

/// Who writes the family's name means one of these.
QString noModel(QStringView name, const Catalog &catalog)
{
    QStringList alike;
    for (const Catalog::ModelInfo &info : catalog.models()) {
        if (!name.trimmed().isEmpty() && info.model.startsWith(name.trimmed(), Qt::CaseInsensitive))
            alike << info.model;
    }
    const QString text = QStringLiteral("no model is called %1").arg(name.toString());
    return alike.isEmpty() ? text
                           : QStringLiteral("%1; those that begin so: %2").arg(text, alike.join(QStringLiteral(", ")));
}

Result<ServoSpec> parseOne(QStringView entry, const Catalog &catalog)
{
    const qsizetype colon = entry.lastIndexOf(u':');
    const qsizetype at = entry.lastIndexOf(u'@');
    if (at < 1 || colon < at)
        return wrongSpec(
            entry, QStringLiteral("a device is written MODEL[/FIRMWARE]@BAUD:ID[+ID2], as in XM430-W350@57600:1"));
    const QStringView device = entry.first(at);
    const qsizetype slash = device.lastIndexOf(u'/');
    ServoSpec spec;
    spec.model = (slash < 0 ? device : device.first(slash)).toString();
    bool ok = true;
    if (slash >= 0)
        spec.firmware = device.sliced(slash + 1).toInt(&ok);
    if (!ok || spec.firmware < -1 || spec.firmware > 255)
        return wrongSpec(entry, QStringLiteral("the firmware is a number from 0 to 255"));
    spec.baudRate = entry.sliced(at + 1, colon - at - 1).toInt(&ok);
    if (!ok)
        spec.baudRate = 0; // no model has it: the message lists those it has
    const QList<QStringView> ids = entry.sliced(colon + 1).split(u'+');
    bool secondOk = true;
    spec.id = ids[0].toInt(&ok);
    if (ids.size() > 1)
        spec.secondId = ids[1].toInt(&secondOk);
    if (!ok || !secondOk || ids.size() > 2 || !isId(spec.id) || (ids.size() == 2 && !isId(spec.secondId)))
        return wrongSpec(entry, QStringLiteral("the ID is a number from 0 to %1").arg(MaximumId));
    if (const auto good = checkServoSpec(spec, catalog); !good)
        return wrongSpec(entry, good.error().text);
    return spec;
}

} // namespace

Result<void> checkServoSpec(ServoSpec &spec, const Catalog &catalog)
{
    const Catalog::ModelInfo *info = catalog.model(QStringView(spec.model));
    if (!info)
        return failure(ErrorKind::NotFound, noModel(spec.model, catalog));
    spec.model = info->model;
    if (info->addressesOnly)
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("of %1 only the addresses are public, which is not enough to simulate it")
                           .arg(info->model));
    const ControlTablePtr table = catalog.find(info->modelNumber, spec.firmware < 0 ? info->newestFirmware
                                                                                    : spec.firmware);
    if (!table)
        return failure(ErrorKind::NotFound, QStringLiteral("no table of %1 is known for that firmware").arg(info->model));
    if (table->description().baudCodes.empty())
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("the table of %1 doesn't say its baud rates, without which it can't be simulated")
                           .arg(info->model));
    if (!table->baudCode(spec.baudRate)) {
        QStringList rates;
        for (const BaudCode &code : table->description().baudCodes)
            rates.append(QString::number(code.rate));
        return failure(ErrorKind::InvalidArgument, QStringLiteral("the rates of %1 are %2")
                                                       .arg(info->model, rates.join(QStringLiteral(", "))));
    }
    const int axes = table->description().axes;
    if ((axes == 2) != (spec.secondId >= 0))
        return failure(ErrorKind::InvalidArgument,
                       axes == 2 ? QStringLiteral("%1 has two axes and needs two IDs").arg(info->model)
                                 : QStringLiteral("%1 has one axis and takes one ID").arg(info->model));
    if (axes == 2 && spec.id == spec.secondId)
        return failure(ErrorKind::InvalidArgument, QStringLiteral("the two axes need different IDs"));
    return {};
}

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
