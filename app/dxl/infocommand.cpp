// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/registers.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "core/table/units.h"

#include <algorithm>
#include <array>

namespace dynascope::dxl {

namespace {

/// What one wants to know first; those that a model lacks are left out.
constexpr std::array<QStringView, 13> First{
    u"Operating Mode", u"Torque Enable",         u"Hardware Error Status", u"Present Position", u"Present Current",
    u"Present Load",   u"Present Input Voltage", u"Present Temperature",   u"Moving",           u"Shutdown",
    u"Secondary ID",   u"Status Return Level",   u"Return Delay Time",
};

QString firmwareText(const ControlTable::Description &table)
{
    return table.firmwareTo >= 255 ? QStringLiteral("firmware %1 and newer").arg(table.firmwareFrom)
                                   : QStringLiteral("firmware %1 to %2").arg(table.firmwareFrom).arg(table.firmwareTo);
}

QString infoText(Device &device, const std::vector<Reading> &readings)
{
    const Found &found = device.found();
    std::vector<QStringList> rows;
    if (const ControlTable *table = device.table()) {
        rows.push_back({QStringLiteral("Series"), table->description().series});
        rows.push_back({QStringLiteral("Table"),
                        QStringLiteral("%1, %2").arg(table->model(), firmwareText(table->description()))});
        if (table->isNewerThanKnown(found.firmware))
            rows.push_back({QStringLiteral("Note"),
                            QStringLiteral("firmware %1 is newer than the newest known, %2: its table may differ")
                                .arg(found.firmware)
                                .arg(table->description().newestFirmware)});
    } else {
        rows.push_back({QStringLiteral("Table"), QStringLiteral("none; registers are reached as ADDRESS:LENGTH")});
    }
    rows.push_back({QStringLiteral("Baud rate"), QStringLiteral("%1 bps").arg(found.baudRate)});
    for (const Reading &one : readings) {
        const QString value =
            one.raw ? valueText(*one.field, device.units(*one.field), device.table()->resolution(), *one.raw)
                    : one.error;
        rows.push_back({one.field->name, value});
    }
    if (device.table())
        rows.push_back({QStringLiteral("Manual"), device.table()->description().manualPage});
    QStringList lines;
    for (const QString &line : aligned(rows, {0, 1}).split(u'\n'))
        lines << QStringLiteral("  ") + line;
    return QStringLiteral("ID %1: %2 (model %3), firmware %4%5\n%6")
        .arg(QString::number(found.id), device.model(), QString::number(found.modelNumber),
             QString::number(found.firmware),
             found.alert ? QStringLiteral(", alert: see Hardware Error Status") : QString(), lines.join(u'\n'));
}

Document infoDocument(Device &device, const std::vector<Reading> &readings)
{
    const Found &found = device.found();
    Document document;
    document.add("id", qint64(found.id))
        .add("baud", qint64(found.baudRate))
        .add("model", device.model())
        .add("model_number", qint64(found.modelNumber))
        .add("firmware", qint64(found.firmware))
        .addFlag("alert", found.alert);
    if (const ControlTable *table = device.table()) {
        document.add("series", table->description().series)
            .add("table_firmware_from", qint64(table->description().firmwareFrom))
            .add("table_firmware_to", qint64(table->description().firmwareTo))
            .add("manual", table->description().manualPage);
    }
    std::vector<Document> registers;
    for (const Reading &one : readings) {
        if (one.raw)
            registers.push_back(fieldDocument(device, *one.field, device.units(*one.field), *one.raw));
    }
    return document.add("registers", registers);
}

Result<void> showInfo(const Work &work, Device &device)
{
    std::vector<Reading> readings;
    if (device.table() && !device.isMute()) {
        const auto wanted = [](const Field &field) {
            return std::ranges::any_of(First, [&](QStringView name) { return name == field.name; });
        };
        auto all = readFields(device, wanted, [](double) {});
        if (!all)
            return tl::unexpected(all.error());
        readings = std::move(*all);
        std::ranges::sort(readings, {}, [](const Reading &one) {
            return std::ranges::find(First, QStringView(one.field->name)) - First.begin();
        });
    }
    work.output.result(infoText(device, readings), infoDocument(device, readings));
    if (device.isMute())
        work.output.note(
            QStringLiteral("%1: nothing more can be read; write status_return_level=1 first").arg(device.name()));
    return {};
}

} // namespace

ExitCode infoCommand(const Work &work)
{
    return forEachDevice(work, [&](Device &device) { return showInfo(work, device); });
}

} // namespace dynascope::dxl
