// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/modelscommand.h"

#include "app/dxl/showvalue.h"
#include "core/table/tableimport.h"
#include "core/table/units.h"
#include "core/table/usertables.h"

#include <CLI/CLI.hpp>

#include <QFileInfo>
#include <QSaveFile>

#include <cstdio>

namespace dynascope::dxl {

namespace {

QString firmwareText(int newest)
{
    return newest < 0 ? QStringLiteral("-") : QString::number(newest);
}

ExitCode list(const Catalog &catalog, Output &output)
{
    output.expectMany();
    for (const Catalog::ModelInfo &info : catalog.models()) {
        Document document;
        document.add("model", info.model)
            .add("number", qint64(info.modelNumber))
            .add("series", info.series)
            .add("also_called", info.alsoCalled);
        if (info.newestFirmware >= 0)
            document.add("newest_firmware", qint64(info.newestFirmware));
        document.addFlag("addresses_only", info.addressesOnly)
            .addFlag("built_in", info.isBuiltIn)
            .add("file", info.file + QStringLiteral(".json"));
        QString remark = info.addressesOnly ? QStringLiteral("  addresses only") : QString();
        if (!info.isBuiltIn)
            remark += QStringLiteral("  from %1.json").arg(info.file);
        output.result(QStringLiteral("%1 %2 %3 %4%5")
                          .arg(info.modelNumber, 5)
                          .arg(info.model, -26)
                          .arg(info.series, -8)
                          .arg(firmwareText(info.newestFirmware), 3)
                          .arg(remark),
                      document);
    }
    return ExitCode::Done;
}

QString boundText(const Bound &bound)
{
    if (bound.number)
        return QString::number(*bound.number);
    return (bound.negated ? QStringLiteral("-") : QString()) + bound.reg;
}

QString rangeText(const Field &field)
{
    if (!field.minimum.isSet() && !field.maximum.isSet())
        return {};
    return QStringLiteral("%1 to %2").arg(boundText(field.minimum), boundText(field.maximum));
}

QString unitText(const Field &field)
{
    if (field.unit == Unit::None)
        return {};
    return field.scale == 1.0 ? tableUnit(field.unit)
                              : QStringLiteral("%1 %2").arg(field.scale).arg(tableUnit(field.unit));
}

Document registerDocument(const Field &field)
{
    Document document;
    document.add("name", field.name)
        .add("address", qint64(field.address))
        .add("size", qint64(field.size))
        .addFlag("signed", field.isSigned)
        .add("area", areaName(field.area))
        .add("access", accessName(field.access));
    if (field.initial)
        document.add("initial", qint64(*field.initial));
    if (field.minimum.isSet())
        document.add("minimum", boundText(field.minimum));
    if (field.maximum.isSet())
        document.add("maximum", boundText(field.maximum));
    if (field.unit != Unit::None)
        document.add("unit", tableUnit(field.unit)).add("scale", field.scale);
    if (!field.help.isEmpty())
        document.add("help", field.help);
    if (!field.doubt.isEmpty())
        document.add("doubt", field.doubt);
    return document;
}

QString registerLine(const Field &field)
{
    QString line = QStringLiteral("%1 %2 %3 %4 %5")
                       .arg(field.address, 5)
                       .arg((field.isSigned ? QStringLiteral("-") : QString()) + QString::number(field.size), 2)
                       .arg(areaName(field.area), -6)
                       .arg(accessName(field.access), -2)
                       .arg(field.name, -32);
    QStringList more;
    if (field.initial)
        more.append(QStringLiteral("= %1").arg(*field.initial));
    if (const QString range = rangeText(field); !range.isEmpty())
        more.append(range);
    if (const QString unit = unitText(field); !unit.isEmpty())
        more.append(unit);
    if (!field.doubt.isEmpty())
        more.append(QStringLiteral("(doubtful: %1)").arg(field.doubt));
    line += more.join(QStringLiteral(", "));
    while (line.endsWith(u' '))
        line.chop(1);
    return line;
}

/// The table that MODEL[/FIRMWARE] names; the model by name or number.
Result<std::pair<ControlTablePtr, int>> named(const Catalog &catalog, const QString &text)
{
    const qsizetype slash = text.lastIndexOf(u'/');
    const QString model = slash < 0 ? text : text.left(slash);
    bool isNumber = false;
    const int number = model.toInt(&isNumber);
    const Catalog::ModelInfo *info = isNumber ? catalog.model(number) : catalog.model(QStringView(model));
    if (!info) {
        return failure(ErrorKind::NotFound,
                       QStringLiteral("no model is called %1; dxl models lists them all").arg(model));
    }
    bool ok = true;
    const int firmware = slash < 0 ? info->newestFirmware : text.mid(slash + 1).toInt(&ok);
    if (!ok || firmware > 255 || (slash >= 0 && firmware < 0))
        return failure(ErrorKind::InvalidArgument, QStringLiteral("the firmware is a number from 0 to 255"));
    return std::pair(catalog.find(info->modelNumber, firmware), firmware);
}

QStringList remarks(const ControlTable &table, int firmware)
{
    const ControlTable::Description &model = table.description();
    QStringList lines;
    if (table.isNewerThanKnown(firmware)) {
        lines.append(QStringLiteral("Firmware %1 is newer than the newest known, %2: its table may differ.")
                         .arg(firmware)
                         .arg(model.newestFirmware));
    }
    if (!model.alsoCalled.isEmpty())
        lines.append(QStringLiteral("Also called %1.").arg(model.alsoCalled.join(QStringLiteral(", "))));
    if (!model.doubt.isEmpty())
        lines.append(QStringLiteral("Doubtful: %1").arg(model.doubt));
    if (!model.manualPage.isEmpty())
        lines.append(model.manualPage);
    return lines;
}

ExitCode show(const Catalog &catalog, const QString &text, Output &output)
{
    const auto found = named(catalog, text);
    if (!found)
        return output.refuse(found.error());
    const ControlTable &table = *found->first;
    const ControlTable::Description &model = table.description();
    QStringList lines{QStringLiteral("%1, model number %2, series %3, firmware %4 to %5")
                          .arg(model.model)
                          .arg(model.modelNumber)
                          .arg(model.series)
                          .arg(model.firmwareFrom)
                          .arg(model.firmwareTo)};
    lines += remarks(table, found->second);
    Document document;
    document.add("model", model.model)
        .add("number", qint64(model.modelNumber))
        .add("series", model.series)
        .add("firmware_from", qint64(model.firmwareFrom))
        .add("firmware_to", qint64(model.firmwareTo))
        .addFlag("newer_than_known", table.isNewerThanKnown(found->second))
        .addFlag("addresses_only", model.addressesOnly)
        .add("resolution", qint64(model.resolution));
    if (!model.doubt.isEmpty())
        document.add("doubt", model.doubt);
    std::vector<Document> registers;
    for (const Field &field : table.fields()) {
        lines.append(registerLine(field));
        registers.push_back(registerDocument(field));
    }
    document.add("registers", registers);
    output.result(lines.join(u'\n'), document);
    return ExitCode::Done;
}

ExitCode check(const Catalog &catalog, const QString &path, Output &output)
{
    const Result<QByteArray> json = readTableFile(path);
    if (!json)
        return output.fail(json.error());
    Catalog with = catalog;
    const std::size_t before = with.models().size();
    if (const Result<void> added = with.add(*json, path); !added)
        return output.fail(added.error());
    const auto models = static_cast<qint64>(with.models().size() - std::min(before, with.models().size()));
    Document document;
    document.add("file", path).addFlag("sound", true).add("models", models);
    output.result(models == 1 ? QStringLiteral("%1: sound, 1 new model").arg(path)
                              : QStringLiteral("%1: sound, %2 new models").arg(path).arg(models),
                  document);
    return ExitCode::Done;
}

ExitCode save(const QString &path, const QByteArray &json, Output &output)
{
    if (QFileInfo::exists(path)) {
        return output.refuse({ErrorKind::InvalidArgument,
                              QStringLiteral("%1 is there already; give another name or remove it").arg(path), 0});
    }
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(json) != json.size() || !file.commit())
        return output.fail({ErrorKind::BadFile, QStringLiteral("%1: %2").arg(path, file.errorString()), 0});
    output.note(QStringLiteral("written to %1; files in %2 are read at every start").arg(path, userTablesFolder()));
    return ExitCode::Done;
}

ExitCode importFile(const ModelsArguments &arguments, Output &output)
{
    const QString path = QString::fromStdString(arguments.file);
    const Result<QByteArray> bytes = readTableFile(path);
    if (!bytes)
        return output.fail(bytes.error());
    const auto table = importTable(*bytes, path.mid(path.lastIndexOf(u'/') + 1),
                                   {QString::fromStdString(arguments.name), arguments.number});
    if (!table)
        return output.fail(table.error());
    for (const QString &note : table->notes)
        output.note(note);
    if (!arguments.out.empty())
        return save(QString::fromStdString(arguments.out), table->json, output);
    const auto size = static_cast<std::size_t>(table->json.size());
    if (std::fwrite(table->json.constData(), 1, size, stdout) != size || std::fflush(stdout) != 0)
        return output.fail({ErrorKind::BadFile, QStringLiteral("standard output takes no more: nothing is complete")});
    return ExitCode::Done;
}

} // namespace

void describeModels(CLI::App &app, ModelsArguments &typed)
{
    using Act = ModelsArguments::Act;
    CLI::App *models =
        app.add_subcommand("models", "The devices that are known and their control tables; needs no port");
    models->require_subcommand(0, 1);
    const auto act = [&](const char *name, const char *text, Act value) {
        CLI::App *command = models->add_subcommand(name, text);
        command->callback([&typed, value] { typed.act = value; });
        return command;
    };
    act("list", "All of them (what models alone does)", Act::List);
    act("show", "The registers of one", Act::Show)
        ->add_option("MODEL[/FIRMWARE]", typed.model,
                     "By name or model number; the newest firmware unless one is given")
        ->required()
        ->type_name({});
    act("check", "Is a table file of your own sound?", Act::Check)
        ->add_option("FILE", typed.file, "JSON, as FORMAT.md describes it")
        ->required()
        ->type_name({});
    CLI::App *import = act("import", "Make a table file of a ROBOTIS .model file or a CSV", Act::Import);
    import->add_option("FILE", typed.file, "What to read")->required()->type_name({});
    import->add_option("--out", typed.out, "Where to write (standard output)")->type_name("FILE");
    import->add_option("--name", typed.name, "The model's name (that of the file)")->type_name("NAME");
    import->add_option("--number", typed.number, "The model's number, where the file doesn't say it")
        ->type_name("N")
        ->check(CLI::Range(0, 65535).description({}));
    models->footer("Tables of your own are read from $DYNASCOPE_TABLES, else from " + userTablesFolder().toStdString()
                   + ".");
}

ExitCode modelsCommand(const Catalog &catalog, const ModelsArguments &arguments, Output &output)
{
    switch (arguments.act) {
    case ModelsArguments::Act::List: return list(catalog, output);
    case ModelsArguments::Act::Show: return show(catalog, QString::fromStdString(arguments.model), output);
    case ModelsArguments::Act::Check: return check(catalog, QString::fromStdString(arguments.file), output);
    case ModelsArguments::Act::Import: break;
    }
    return importFile(arguments, output);
}

} // namespace dynascope::dxl
