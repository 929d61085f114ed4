// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/typed.h"

#include <CLI/CLI.hpp>

namespace dynascope::dxl {

namespace {

constexpr const char *Register = "FIELD by its name in the control table, or ADDRESS:LENGTH in bytes";

void addSeconds(CLI::App &command, Typed &typed, const std::string &help)
{
    command.add_option("--seconds", typed.seconds, help)->type_name("N")->check(CLI::Range(0.01, 1e6).description({}));
}

void describeWatch(CLI::App &app, Typed &typed)
{
    CLI::App *watch = app.add_subcommand("watch", "Read registers again and again, one line a sample, until Ctrl-C");
    addIds(*watch, typed);
    watch->add_option("FIELD", typed.registers, "By its name in the control table")->required()->type_name({});
    watch->add_option("--rate", typed.rate, "Samples a second, or max: as many as the line carries (10)")
        ->type_name("N");
    watch->add_option("--count", typed.count, "End after that many samples")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000'000).description({}));
    addSeconds(*watch, typed, "End after that long");
    watch->add_flag("--csv", typed.csv,
                    "Comma-separated values in the units of the heading; a cell without an answer is "
                    "empty");
    watch->footer("With --json a line is one JSON object. The rate as achieved is said on standard error at the end.");
}

void describeStats(CLI::App &app, Typed &typed)
{
    CLI::App *stats = app.add_subcommand("stats", "Poll the devices at full rate and report how well they answer; "
                                                  "Ctrl-C ends early, with the report");
    addSeconds(*stats, typed, "How long (10)");
    stats->add_option("--watch", typed.registers, "What to read: FIELDs, or ADDRESS:LENGTH in bytes (Present Position)")
        ->type_name("FIELD");
    stats->add_option("--ids", typed.idList, "The devices that should be there: 1,4-7 (whoever a scan finds)")
        ->type_name("LIST");
    stats->footer("Worst device first. !! marks 1 % of bad answers and more, ! 0.1 %.");
}

} // namespace

void describeRegisters(CLI::App &app, Typed &typed)
{
    CLI::App *table = app.add_subcommand("table", "Read the whole control table, in physical units");
    addIds(*table, typed);
    table->footer("A * marks what differs from the factory's value.");

    CLI::App *read = app.add_subcommand("read", "Read registers");
    addIds(*read, typed);
    read->add_option("REGISTER", typed.registers, Register)->required()->type_name({});

    CLI::App *write = app.add_subcommand("write", "Write registers and read them back");
    addIds(*write, typed);
    write->add_option("ASSIGNMENT", typed.registers, "FIELD=VALUE or ADDRESS:LENGTH=VALUE")->required()->type_name({});
    write->add_flag("--explain", typed.explain, "Say what it would bring besides, and write nothing");
    write->add_flag("--safely", typed.safely,
                    "In the right order, with torque off where it must be, and what a mode resets put back");
    write->add_flag("--torque-back", typed.torqueBack,
                    "With --safely: turn torque on again where it was on, with the goal at the present position");
    write->footer(
        "A VALUE is the raw register value (2048, 0x800, -5), physical with a unit (90deg, 30rpm, 200mA, 12.1V, "
        "50%) or the name of an enum value or of bits joined by '+'. Nothing is written before all of it has "
        "been checked for all devices; one that fails afterwards keeps nobody else from being written to. RAM of "
        "several devices is written at once, so that joints set off together; EEPROM one device after the other.");
    describeWatch(app, typed);
    describeStats(app, typed);
}

} // namespace dynascope::dxl
