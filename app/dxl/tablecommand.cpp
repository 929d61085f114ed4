// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/registers.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "core/table/units.h"

namespace dynascope::dxl {

namespace {

/// The factory's value is said of what a person may have changed.
bool isChanged(const Reading &reading)
{
    const Field &field = *reading.field;
    return field.isWritable() && field.initial && reading.raw && *reading.raw != *field.initial;
}

QStringList rowOf(Device &device, const Reading &reading)
{
    const Field &field = *reading.field;
    const QString name =
        field.suggested.isEmpty() ? field.name : QStringLiteral("%1 (%2?)").arg(field.name, field.suggested);
    QStringList row{QString::number(field.address), QString::number(field.size), accessName(field.access), name};
    if (!reading.raw)
        return row << QStringLiteral("-") << QString() << reading.error;
    const QString number = QString::number(*reading.raw);
    const QString value = valueText(field, device.units(field), device.table()->resolution(), *reading.raw);
    return row << number << (isChanged(reading) ? QStringLiteral("*") : QString())
               << (value == number ? QString() : value);
}

QString tableText(Device &device, const std::vector<Reading> &readings)
{
    std::vector<QStringList> rows{{QStringLiteral("Address"), QStringLiteral("Size"), QStringLiteral("Access"),
                                   QStringLiteral("Name"), QStringLiteral("Raw"), QString(), QStringLiteral("Value")}};
    for (const Reading &reading : readings)
        rows.push_back(rowOf(device, reading));
    QStringList lines = aligned(rows, {2, 3, 5, 6}).split(u'\n');
    const ControlTable::Description &model = device.table()->description();
    QString text = QStringLiteral("%1, firmware %2\n").arg(device.name()).arg(device.found().firmware);
    if (model.isRaw)
        text += model.doubt + u'\n';
    text += lines.takeFirst();
    std::optional<Area> area;
    if (model.isRaw)
        area = Area::Unknown; // of all: no heading
    for (qsizetype i = 0; i < lines.size(); ++i) {
        const Area here = readings[static_cast<std::size_t>(i)].field->area;
        if (here != area)
            text += u'\n' + areaName(here);
        area = here;
        text += u'\n' + lines[i];
    }
    return text;
}

Document tableDocument(Device &device, const std::vector<Reading> &readings)
{
    std::vector<Document> registers;
    for (const Reading &reading : readings) {
        const Field &field = *reading.field;
        Document one;
        if (reading.raw) {
            one = fieldDocument(device, field, device.units(field), *reading.raw);
        } else {
            one.add("id", qint64(device.id())).add("field", field.name).add("address", qint64(field.address));
            one.add("error", reading.error);
        }
        one.add("size", qint64(field.size)).add("area", areaName(field.area)).add("access", accessName(field.access));
        if (field.initial)
            one.add("initial", qint64(*field.initial));
        if (!field.suggested.isEmpty())
            one.add("suggested", field.suggested);
        registers.push_back(one);
    }
    Document document;
    return document.add("id", qint64(device.id()))
        .add("model", device.table()->model())
        .add("model_number", qint64(device.found().modelNumber))
        .add("firmware", qint64(device.found().firmware))
        .add("registers", registers);
}

Result<void> showTable(const Work &work, Device &device)
{
    device.takeRawTable(work.catalog);
    const auto readings = readFields(
        device, [](const Field &) { return true; }, [&](double done) { work.output.progress(done, device.name()); });
    if (!readings)
        return tl::unexpected(readings.error());
    work.output.result(tableText(device, *readings), tableDocument(device, *readings));
    return {};
}

} // namespace

ExitCode tableCommand(const Work &work)
{
    return forEachDevice(work, [&](Device &device) { return showTable(work, device); });
}

} // namespace dynascope::dxl
