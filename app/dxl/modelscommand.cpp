// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/modelscommand.h"

#include "core/table/tableimport.h"
#include "core/table/usertables.h"

#include <CLI/CLI.hpp>

#include <QDir>
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

/// The file of these bytes that is used already, whatever it is called; empty where there is none.
QString twinOf(const QByteArray &json, const QString &path)
{
    for (const QString &folder : {QStringLiteral(":/controltables"), userTablesFolder()}) {
        for (const QString &name : QDir(folder).entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
            const QString other = folder + u'/' + name;
            if (QFileInfo(other) == QFileInfo(path))
                continue;
            if (const Result<QByteArray> bytes = readTableFile(other); bytes && *bytes == json)
                return folder.startsWith(u':') ? QStringLiteral("the built-in %1").arg(name) : other;
        }
    }
    return {};
}

ExitCode check(const Catalog &catalog, const QString &path, Output &output)
{
    const Result<QByteArray> json = readTableFile(path);
    if (!json)
        return output.fail(json.error());
    const QString twin = twinOf(*json, path);
    if (twin.startsWith(u"the built-in ")) {
        Document document;
        document.add("file", path).addFlag("sound", true).add("models", qint64(0)).add("same_as", twin);
        output.result(QStringLiteral("%1: sound, the same as %2").arg(path, twin), document);
        return ExitCode::Done;
    }
    Catalog with = catalog;
    const std::size_t before = with.models().size();
    if (const Result<void> added = with.add(*json, path); !added)
        return output.fail(added.error());
    const auto models = static_cast<qint64>(with.models().size() - std::min(before, with.models().size()));
    Document document;
    document.add("file", path).addFlag("sound", true).add("models", models);
    QString text = models == 1 ? QStringLiteral("%1: sound, 1 new model").arg(path)
                               : QStringLiteral("%1: sound, %2 new models").arg(path).arg(models);
    if (!twin.isEmpty()) {
        document.add("same_as", twin);
        text = QStringLiteral("%1: sound, the same as %2").arg(path, twin);
    }
    output.result(text, document);
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

/// What was imported may still be refused where it is to be used.
void sayWhatIsTaken(Catalog catalog, const QByteArray &json, const QString &path, Output &output)
{
    if (const Result<void> added = catalog.add(json, path); !added)
        output.note(QStringLiteral("among your tables it would be refused: %1").arg(added.error().text));
}

ExitCode importFile(const Catalog &catalog, const ModelsArguments &arguments, Output &output)
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
    const QString out = QString::fromStdString(arguments.out);
    if (out.isEmpty() || !QFileInfo::exists(out)) // else that is said
        sayWhatIsTaken(catalog, table->json, out.isEmpty() ? path : out, output);
    if (!out.isEmpty())
        return save(out, table->json, output);
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
    case ModelsArguments::Act::Show: return showModel(catalog, QString::fromStdString(arguments.model), output);
    case ModelsArguments::Act::Check: return check(catalog, QString::fromStdString(arguments.file), output);
    case ModelsArguments::Act::Import: break;
    }
    return importFile(catalog, arguments, output);
}

} // namespace dynascope::dxl
