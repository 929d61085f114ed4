// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/options.h"

#include "app/dxl/arguments.h"
#include "app/dxl/composepacket.h"
#include "app/dxl/typed.h"
#include "core/session/scanner.h"

#include <CLI/CLI.hpp>

namespace dynascope::dxl {

namespace {

Result<void> understandLine(Options &options, const Typed &typed)
{
    options.port = QString::fromStdString(typed.port);
    options.baudRate = typed.baudRate;
    options.timeout = typed.timeout;
    options.json = !typed.json.empty();
    if (options.json && typed.json != "true" && typed.json != std::to_string(JsonVersion)) {
        return wrong(QStringLiteral("this program writes version %1 of its JSON, not \"%2\"")
                         .arg(QString::number(JsonVersion), QString::fromStdString(typed.json)));
    }
    options.verbose = typed.verbose;
    options.bauds = {options.baudRate};
    if (!typed.bauds)
        return {};
    const auto bauds = parseBauds(QString::fromStdString(*typed.bauds), allBauds());
    if (!bauds)
        return wrong(QStringLiteral("--bauds: ") + bauds.error().text);
    options.bauds = *bauds;
    return {};
}

Result<void> understandIds(Options &options, const Typed &typed)
{
    const auto range = parseIds(QString::fromStdString(typed.scanIds));
    if (!range)
        return tl::unexpected(range.error());
    options.ids = *range;
    const std::string &list = typed.idList ? *typed.idList : typed.ids;
    if (list.empty() && !typed.idList)
        return {};
    auto ids = parseIdList(QString::fromStdString(list));
    if (!ids)
        return tl::unexpected(ids.error());
    options.idList = std::move(*ids);
    return {};
}

Result<void> understandRegisters(Options &options, const Typed &typed)
{
    const bool writes = options.command == Command::Write;
    for (const std::string &text : typed.registers) {
        const QString word = QString::fromStdString(text);
        const auto argument = writes ? parseAssignment(word) : parseRegister(word);
        if (!argument)
            return tl::unexpected(argument.error());
        options.registers.push_back(*argument);
        if (!writes || !argument->isByAddress())
            continue;
        if (const auto value = parseRawValue(*argument); !value)
            return tl::unexpected(value.error());
    }
    return {};
}

Result<void> understandWatch(Options &options, const Typed &typed)
{
    options.seconds = typed.seconds;
    options.count = typed.count;
    options.csv = typed.csv;
    if (options.csv && options.json)
        return wrong(QStringLiteral("--csv and --json: one of them"));
    if (typed.rate == "max") {
        options.rate = 0;
        return {};
    }
    bool ok = false;
    options.rate = QString::fromStdString(typed.rate).toDouble(&ok);
    if (!ok || !(options.rate >= 0.001 && options.rate <= 100'000)) {
        return wrong(QStringLiteral("--rate: \"%1\" is not a number of samples a second, 0.001 to 100000, nor max")
                         .arg(QString::fromStdString(typed.rate)));
    }
    return {};
}

/// CLI11 has let only the words of the description pass.
void understandWords(Options &options, const Typed &typed)
{
    options.on = typed.state == "on";
    options.yes = typed.yes;
    options.reset = typed.option == "all"          ? ResetOption::All
                    : typed.option == "all-but-id" ? ResetOption::AllButId
                                                   : ResetOption::AllButIdAndBaud;
    options.clear = typed.option == "error" ? ClearOption::Error : ClearOption::Position;
    options.models = typed.models;
    options.shell = QString::fromStdString(typed.shell);
    options.model = QString::fromStdString(typed.model.value_or(std::string()));
    options.sweep = typed.sweep;
    options.explain = typed.explain;
    options.safely = typed.safely;
    options.torqueBack = typed.torqueBack;
    options.listen = typed.listen;
}

Result<void> understandPacket(Options &options, const Typed &typed)
{
    if (typed.hex.has_value() == !typed.words.empty())
        return wrong(QStringLiteral("packet takes an instruction or --hex, one of them; dxl packet --help tells more"));
    if (typed.raw && !typed.hex)
        return wrong(QStringLiteral("--raw is for --hex: what is composed is right"));
    QStringList words;
    for (const std::string &word : typed.words)
        words << QString::fromStdString(word);
    auto packet = typed.hex ? packetFromHex(QString::fromStdString(*typed.hex), typed.raw) : composePacket(words);
    if (!packet)
        return tl::unexpected(packet.error());
    options.packet = std::move(*packet);
    return {};
}

Result<void> understandBackups(Options &options, const Typed &typed)
{
    const Command command = options.command;
    if (command != Command::Backup && command != Command::Restore && command != Command::Compare)
        return {};
    auto backup = command == Command::Backup    ? typed.backup.understandBackup()
                  : command == Command::Restore ? typed.backup.understandRestore()
                                                : typed.backup.understandCompare();
    if (!backup)
        return tl::unexpected(backup.error());
    options.backup = std::move(*backup);
    options.idList = options.backup.ids;
    options.yes = options.backup.yes;
    return {};
}

Result<Options> understand(const CLI::App &app, const Typed &typed)
{
    Options options;
    if (app.get_subcommands().empty())
        return wrong(QStringLiteral("say what to do: scan, info, read, write, watch...; dxl --help tells more"));
    options.command = commandNamed(app.get_subcommands().front()->get_name());
    understandWords(options, typed);
    for (const auto part : {understandLine, understandIds, understandRegisters, understandWatch}) {
        if (const Result<void> understood = part(options, typed); !understood)
            return tl::unexpected(understood.error());
    }
    if (const Result<void> understood = understandBackups(options, typed); !understood)
        return tl::unexpected(understood.error());
    if (options.command == Command::Sim) {
        auto sim = typed.sim.understand();
        if (!sim)
            return tl::unexpected(sim.error());
        options.sim = std::move(*sim);
    }
    if (options.command == Command::Journal) {
        auto journal = typed.journal.understand();
        if (!journal)
            return tl::unexpected(journal.error());
        options.journal = std::move(*journal);
    }
    if (options.command == Command::Move) {
        auto move = typed.move.understand();
        if (!move)
            return tl::unexpected(move.error());
        options.move = std::move(*move);
    }
    if (options.command == Command::Profile) {
        auto profile = typed.profile.understand();
        if (!profile)
            return tl::unexpected(profile.error());
        options.profile = std::move(*profile);
    }
    if (options.command == Command::Commission) {
        auto commission = typed.commission.understand();
        if (!commission)
            return tl::unexpected(commission.error());
        options.commission = std::move(*commission);
    }
    auto record = typed.record.understand();
    if (!record)
        return tl::unexpected(record.error());
    options.record = std::move(*record);
    if (options.command == Command::Packet) {
        if (const Result<void> understood = understandPacket(options, typed); !understood)
            return tl::unexpected(understood.error());
    }
    if (options.explain && options.safely)
        return wrong(QStringLiteral("--explain and --safely: one of them"));
    if (options.torqueBack && !options.safely)
        return wrong(QStringLiteral("--torque-back belongs to --safely"));
    if (options.command == Command::Stop && !options.model.isEmpty() && options.idList.empty())
        return wrong(QStringLiteral("--model says what the devices are that IDS names; there are none"));
    return options;
}

/// The word that stands where a command should; empty where a command, or only options, were given.
std::string unknownCommand(const CLI::App &app)
{
    const std::vector<std::string> left = app.remaining();
    const bool isWord = !left.empty() && !left.front().empty() && left.front().front() != '-';
    return isWord && app.get_subcommands().empty() ? left.front() : std::string();
}

} // namespace

tl::expected<Options, ExitCode> parseOptions(int argc, const char *const *argv)
{
    CLI::App app("Find, read, write and watch DYNAMIXEL servos (Protocol 2.0).", "dxl");
    Typed typed;
    describe(app, typed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        const bool isWrong = error.get_exit_code() != 0;
        if (const std::string unknown = unknownCommand(app); isWrong && !unknown.empty())
            std::fprintf(stderr, "dxl: there is no command \"%s\"; dxl --help lists them\n", unknown.c_str());
        else if (isWrong)
            std::fprintf(stderr, "dxl: %s; dxl --help tells more\n", error.what());
        else
            app.exit(error); // --help, --version
        return tl::unexpected(isWrong ? ExitCode::Usage : ExitCode::Done);
    }
    const auto options = understand(app, typed);
    if (!options) {
        std::fprintf(stderr, "dxl: %s\n", qUtf8Printable(options.error().text));
        return tl::unexpected(ExitCode::Usage);
    }
    return *options;
}

} // namespace dynascope::dxl
