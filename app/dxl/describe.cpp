// SPDX-License-Identifier: GPL-3.0-or-later
// Global options and the commands that find devices; registers and actions are described beside this.
#include "app/dxl/helpformatter.h"
#include "app/dxl/modelscommand.h"
#include "app/dxl/typed.h"

#include <algorithm>
#include <array>

namespace dynascope::dxl {

namespace {

struct Name {
    const char *text;
    Command command;
};

constexpr std::array Names{
    Name{"backup", Command::Backup}, Name{"clear", Command::Clear}, Name{"commission", Command::Commission},
    Name{"compare", Command::Compare}, Name{"completion", Command::Completion},
    Name{"convert", Command::Convert},
    Name{"info", Command::Info},     Name{"journal", Command::Journal}, Name{"led", Command::Led},
    Name{"models", Command::Models}, Name{"move", Command::Move},     Name{"packet", Command::Packet},
    Name{"ping", Command::Ping},     Name{"ports", Command::Ports},   Name{"profile", Command::Profile},
    Name{"read", Command::Read},     Name{"reboot", Command::Reboot}, Name{"record", Command::Record}, Name{"replay", Command::Replay}, Name{"reset", Command::Reset},
    Name{"restore", Command::Restore}, Name{"scan", Command::Scan},
    Name{"sim", Command::Sim},       Name{"stats", Command::Stats},   Name{"stop", Command::Stop},
    Name{"table", Command::Table},   Name{"torque", Command::Torque}, Name{"version", Command::Version},
    Name{"watch", Command::Watch},   Name{"write", Command::Write},
};

void describeGlobals(CLI::App &app, Typed &typed)
{
    app.formatter(std::make_shared<HelpFormatter>());
    app.fallthrough(); // --port may also stand behind the command
    app.require_subcommand(0, 1);
    app.set_help_flag("-h,--help", "Print this and end");
    app.set_version_flag("--version", "dxl " DYNASCOPE_VERSION, "Print the program's version and end");
    app.add_option("--port", typed.port,
                   "The line's port: /dev/ttyUSB0; sim, a demo arm at 1000000 bps; or a serial server: tcp://HOST:PORT "
                   "(raw bytes, the rate is the server's), rfc2217://HOST:PORT (sets the rate). May be left out where "
                   "there is just one adapter")
        ->type_name("PORT");
    app.add_option("--baud", typed.baudRate, "The line's baud rate, bits per second (57600)")
        ->type_name("N")
        ->check(CLI::Range(LowestBaudRate, HighestBaudRate).description({}));
    app.add_option("--timeout", typed.timeout,
                   "How late an answer may come on account of adapter, host and network, in ms on top of what wire and "
                   "servo take (what the kind of port is known for: 6 to 50)")
        ->type_name("MS")
        ->check(CLI::Range(1, 60'000).description({}));
    app.add_flag("--json", typed.json, "JSON on standard output; --json=1 insists on version 1 of its shape");
    app.add_flag("-v,--verbose", typed.verbose, "Show every packet on standard error, and what it says");
    app.footer("Devices (IDS) are named as 1,3-5. Exit code: 0 done, 1 a device or the line failed, 2 wrong usage and "
               "nothing was written, 3 sent, but not confirmed, 130 interrupted, 141 nobody reads standard output.\n"
               "dxl COMMAND --help tells more of a command; so does man dxl.");
}

} // namespace

Command commandNamed(const std::string &name)
{
    const auto found = std::ranges::find_if(Names, [&](const Name &one) { return name == one.text; });
    return found == Names.end() ? Command::Version : found->command;
}

void addIds(CLI::App &command, Typed &typed)
{
    command.add_option("IDS", typed.ids, "The devices, 0 to 252: 7 or 1,3-5")->required()->type_name({});
}

void describeFinding(CLI::App &app, Typed &typed)
{
    app.add_subcommand("ports", "List the serial ports and what is known of their adapters");
    CLI::App *scan = app.add_subcommand("scan", "Find the devices on the line");
    scan->add_option("--bauds", typed.bauds, "Baud rates to try: 57600,1000000 or all (that of --baud)")
        ->type_name("LIST");
    scan->add_option("--ids", typed.scanIds, "IDs to look for (0-252)")->type_name("RANGE");
    scan->add_flag("--sweep", typed.sweep, "Ask every ID by itself, for buses on which a Ping to all fails; slow");
    addIds(*app.add_subcommand("ping", "Is a device there, and what is it?"), typed);
    addIds(*app.add_subcommand("info", "Model, firmware, state and health of a device, with its Hardware Error named"),
           typed);
}

void describe(CLI::App &app, Typed &typed)
{
    describeGlobals(app, typed);
    describeFinding(app, typed);
    describeRegisters(app, typed);
    describeRecordings(app, typed);
    describeActions(app, typed);
    describePacket(app, typed);
    typed.move.describe(app);
    typed.commission.describe(app);
    typed.profile.describe(app, typed.yes);
    typed.journal.describe(app);
    typed.sim.describe(app);
    describeModels(app, typed.models);
    app.add_subcommand("completion", "Print a completion script for a shell")
        ->add_option("SHELL", typed.shell, "bash, zsh or fish")
        ->required()
        ->type_name({})
        ->check(CLI::IsMember({"bash", "zsh", "fish"}).description({}));
    app.add_subcommand("version", "Print the versions of the program and of the JSON it writes");
    app.set_help_all_flag("--help-all", "Print the help of all commands and end"); // last: a command has none
}

} // namespace dynascope::dxl
