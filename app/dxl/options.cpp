// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/options.h"

#include "core/protocol/protocol_values.h"
#include "core/session/scanner.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace dynascope::dxl {

namespace {

/// As typed, before our own languages are read.
struct Typed {
    std::string port, ids = "0-252";
    std::optional<std::string> bauds, idList;
    double seconds = 10;
    int baudRate = 57600;
    int id = 0;
    bool json = false;
    bool verbose = false;
    bool sweep = false;
    std::vector<std::string> registers;
    SimArguments sim;
};

constexpr const char *Values =
    "A VALUE is the raw register value (2048, 0x800, -5), physical with a unit (90deg, 30rpm, 200mA, 12.1V, 50%) or the "
    "name of an enum value or of bits joined by '+'.";

void describeStats(CLI::App &app, Typed &typed)
{
    CLI::App *stats = app.add_subcommand("stats", "Poll the devices at full rate and report how well they answer; "
                                                  "Ctrl-C ends early, with the report");
    stats->add_option("--seconds", typed.seconds, "How long (10)")
        ->type_name("N")
        ->check(CLI::Range(0.01, 1e6).description({}));
    stats->add_option("--watch", typed.registers, "What to read: FIELDs, or ADDRESS:LENGTH in bytes (Present Position)")
        ->type_name("FIELD");
    stats->add_option("--ids", typed.idList, "The devices that should be there: 1,4-7 (whoever a scan finds)")
        ->type_name("LIST");
    stats->footer("Worst device first. !! marks 1 % of bad answers and more, ! 0.1 %.");
}

void describe(CLI::App &app, Typed &typed)
{
    app.fallthrough(); // --port may also stand behind the command
    app.require_subcommand(0, 1);
    app.set_version_flag("--version", "dxl " DYNASCOPE_VERSION);
    app.add_option("--port", typed.port,
                   "The line's port: /dev/ttyUSB0, or a serial server: tcp://HOST:PORT (raw bytes, "
                   "the rate is the server's), rfc2217://HOST:PORT (sets the rate)")
        ->type_name("PORT");
    app.add_option("--baud", typed.baudRate, "The line's baud rate, bits per second (57600)")
        ->type_name("N")
        ->check(CLI::Range(1, 100'000'000).description({}));
    app.add_flag("--json", typed.json, "One JSON document on standard output");
    app.add_flag("-v,--verbose", typed.verbose, "Show every packet on standard error");
    app.footer("Exit code: 0 done, 1 a device or the line failed, 2 wrong usage and nothing was written, 3 sent, but not "
               "confirmed: the device's Status Return Level 0 lets nothing be read back.");

    CLI::App *scan = app.add_subcommand("scan", "Find the devices on the line");
    scan->add_option("--bauds", typed.bauds, "Baud rates to try: 57600,1000000 or all (that of --baud)")
        ->type_name("LIST");
    scan->add_option("--ids", typed.ids, "IDs to look for (0-252)")->type_name("RANGE");
    scan->add_flag("--sweep", typed.sweep, "Ask every ID by itself, for buses on which a Ping to all fails; slow");

    const auto forDevice = [&](const char *name, const std::string &text) {
        CLI::App *command = app.add_subcommand(name, text);
        command->add_option("ID", typed.id, "The device, 0 to 252")
            ->required()
            ->type_name({})
            ->check(CLI::Range(0, int(MaximumId)).description({}));
        return command;
    };
    forDevice("ping", "Is a device there, and what is it?");
    forDevice("read", "Read registers")
        ->add_option("REGISTER", typed.registers, "FIELD by its name in the control table, or ADDRESS:LENGTH in bytes")
        ->required()
        ->type_name({});
    forDevice("write", "Write registers and read them back")
        ->footer(Values)
        ->add_option("ASSIGNMENT", typed.registers, "FIELD=VALUE or ADDRESS:LENGTH=VALUE")
        ->required()
        ->type_name({});

    describeStats(app, typed);

    typed.sim.describe(app);
}

Result<Options> understand(const CLI::App &app, const Typed &typed)
{
    Options options;
    if (app.get_subcommands().empty())
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("say what to do: scan, ping, read, write, stats or sim; dxl --help tells more"));
    const std::string name = app.get_subcommands().front()->get_name();
    options.command = name == "scan" ? Command::Scan
        : name == "ping"             ? Command::Ping
        : name == "read"             ? Command::Read
        : name == "write"            ? Command::Write
        : name == "stats"            ? Command::Stats
                                     : Command::Sim;
    options.port = QString::fromStdString(typed.port);
    options.baudRate = typed.baudRate;
    options.json = typed.json;
    options.verbose = typed.verbose;
    options.id = static_cast<std::uint8_t>(typed.id);
    if (options.command == Command::Sim) {
        auto sim = typed.sim.understand();
        if (!sim)
            return tl::unexpected(sim.error());
        options.sim = std::move(*sim);
    }
    if (options.port.isEmpty() && options.command != Command::Sim)
        return failure(ErrorKind::InvalidArgument, QStringLiteral("%1 needs a port: dxl --port PATH %1")
                                                       .arg(QString::fromStdString(name)));

    options.bauds = {options.baudRate};
    if (typed.bauds) {
        const auto bauds = parseBauds(QString::fromStdString(*typed.bauds), allBauds());
        if (!bauds)
            return failure(ErrorKind::InvalidArgument, QStringLiteral("--bauds: ") + bauds.error().text);
        options.bauds = *bauds;
    }
    const auto ids = parseIds(QString::fromStdString(typed.ids));
    if (!ids)
        return tl::unexpected(ids.error());
    options.ids = *ids;
    options.sweep = typed.sweep;
    options.seconds = typed.seconds;
    if (typed.idList) {
        auto list = parseIdList(QString::fromStdString(*typed.idList));
        if (!list)
            return tl::unexpected(list.error());
        options.idList = std::move(*list);
    }

    for (const std::string &text : typed.registers) {
        const auto argument = options.command == Command::Write ? parseAssignment(QString::fromStdString(text))
                                                                : parseRegister(QString::fromStdString(text));
        if (!argument)
            return tl::unexpected(argument.error());
        options.registers.push_back(*argument);
        if (options.command != Command::Write || !argument->isByAddress())
            continue;
        if (const auto value = parseRawValue(*argument); !value)
            return tl::unexpected(value.error());
    }
    return options;
}

} // namespace

tl::expected<Options, ExitCode> parseOptions(int argc, const char *const *argv)
{
    CLI::App app("Find, read and write DYNAMIXEL servos (Protocol 2.0).", "dxl");
    Typed typed;
    describe(app, typed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        const bool wrong = error.get_exit_code() != 0;
        if (wrong)
            std::fprintf(stderr, "dxl: %s; dxl --help tells more\n", error.what());
        else
            app.exit(error); // --help, --version
        return tl::unexpected(wrong ? ExitCode::Usage : ExitCode::Done);
    }
    const auto options = understand(app, typed);
    if (!options) {
        std::fprintf(stderr, "dxl: %s\n", qUtf8Printable(options.error().text));
        return tl::unexpected(ExitCode::Usage);
    }
    return *options;
}

} // namespace dynascope::dxl
