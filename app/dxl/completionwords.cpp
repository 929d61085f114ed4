// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/completionwords.h"

#include "app/dxl/composepacket.h"
#include "app/dxl/typed.h"
#include "core/sim/control.h"
#include "core/table/catalog.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>

namespace dynascope::dxl {

namespace {

QStringList split(const char16_t *words)
{
    return QString::fromUtf16(words).split(u' ', Qt::SkipEmptyParts);
}

/// What fits beside a word: up to the first full stop, bracket or semicolon.
QString inShort(const std::string &help)
{
    QString text = QString::fromStdString(help);
    for (const QString &end : {QStringLiteral(". "), QStringLiteral(" ("), QStringLiteral("; ")})
        text = text.section(end, 0, 0);
    return text.trimmed();
}

QStringList wordsBehind(const QString &command)
{
    if (command == u"torque" || command == u"led")
        return split(u"on off");
    if (command == u"reset")
        return split(u"all all-but-id all-but-id-and-baud");
    if (command == u"clear")
        return split(u"position error");
    if (command == u"completion")
        return split(u"bash zsh fish");
    if (command == u"models")
        return split(u"list show check import");
    if (command == u"profile")
        return split(u"save check diff apply");
    if (command == u"packet")
        return instructionNames();
    if (command != u"sim")
        return {};
    QStringList words{QStringLiteral("ctl")}; // and what stands behind it
    for (const QString &line : sim::Control::commandHelp())
        words << line.section(u' ', 0, 0).remove(u':');
    return words;
}

Words wordsOf(const CLI::App &app)
{
    Words words;
    words.name = QString::fromStdString(app.get_name());
    words.help = inShort(app.get_description());
    words.words = wordsBehind(words.name);
    words.takesFiles = split(u"sim models profile backup restore compare").contains(words.name); // ctl PATH, check FILE
    for (const CLI::Option *option : app.get_options()) {
        for (const std::string &name : option->get_lnames()) {
            words.options << QStringLiteral("--") + QString::fromStdString(name);
            words.helps << inShort(option->get_description());
        }
        const std::string name = option->get_name();
        if (name == "ASSIGNMENT")
            words.fields = Words::Fields::Assignments;
        else if (name == "REGISTER" || name == "FIELD")
            words.fields = Words::Fields::Names;
    }
    return words;
}

/// Names that a shell would take apart have to be typed in quotes, and are not completed.
bool isOneWord(const QString &name)
{
    return std::ranges::all_of(name, [](QChar c) {
        return c.unicode() < 128 && (c.isLetterOrNumber() || QStringView(u"_-.+").contains(c));
    });
}

QStringList fieldNames(const Catalog &catalog)
{
    std::set<QString> names;
    for (const Catalog::ModelInfo &model : catalog.models()) {
        const ControlTablePtr table = catalog.find(model.modelNumber, model.newestFirmware);
        for (const Field &field : table->fields()) {
            const QString name = field.name.toLower().replace(u' ', u'_');
            if (!name.startsWith(QLatin1String("indirect")) && isOneWord(name))
                names.insert(name);
        }
    }
    return {names.begin(), names.end()};
}

ValuedOption valued(const QString &name, const Catalog &catalog, const QStringList &fields)
{
    const QStringList rates = split(u"9600 57600 115200 1000000 2000000 3000000 4000000 4500000");
    if (name == u"--port")
        return {name, split(u"sim tcp:// rfc2217://"), true};
    if (name == u"--link" || name == u"--bus" || name == u"--folder" || name == u"--output")
        return {name, {}, true};
    if (name == u"--baud")
        return {name, rates};
    if (name == u"--bauds")
        return {name, QStringList{QStringLiteral("all")} + rates};
    if (name == u"--rate")
        return {name, split(u"max")};
    if (name == u"--control")
        return {name, split(u"-")};
    if (name == u"--calibration")
        return {name, split(u"yes no")};
    if (name == u"--watch" || name == u"--only" || name == u"--except")
        return {name, fields};
    if (name != u"--model")
        return {name, {}};
    QStringList models;
    for (const Catalog::ModelInfo &model : catalog.models()) {
        if (isOneWord(model.model))
            models << model.model;
    }
    return {name, models};
}

} // namespace

QStringList Completions::names() const
{
    QStringList names;
    for (const Words &command : commands)
        names << command.name;
    return names;
}

Completions completionsOf(const Catalog &catalog)
{
    CLI::App app("", "dxl");
    Typed typed;
    describe(app, typed);
    Completions all;
    all.program = wordsOf(app);
    all.fields = fieldNames(catalog);
    std::vector<const CLI::App *> apps{&app};
    for (const CLI::App *command : app.get_subcommands({})) {
        all.commands.push_back(wordsOf(*command));
        apps.push_back(command);
    }
    for (const CLI::App *one : apps) {
        for (const CLI::Option *option : one->get_options()) {
            if (option->get_lnames().empty() || option->get_type_name().empty()) // a flag
                continue;
            const QString name = QStringLiteral("--") + QString::fromStdString(option->get_lnames().front());
            if (std::ranges::find(all.valued, name, &ValuedOption::name) == all.valued.end())
                all.valued.push_back(valued(name, catalog, all.fields));
        }
    }
    return all;
}

} // namespace dynascope::dxl
