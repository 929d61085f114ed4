// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/recordoptions.h"

#include "app/dxl/typed.h"

#include <CLI/CLI.hpp>

namespace dynascope::dxl {
namespace {

constexpr const char *UdpHelp = "Send each sample as JSON to PORT on this machine, or HOST:PORT, as PlotJuggler's UDP "
                                "server takes it";

/// A number from `low` to `high`, or "max", which is 0.
Result<double> numberOrMax(const char *option, const std::string &text, double low, double high)
{
    bool ok = false;
    const double number = QString::fromStdString(text).toDouble(&ok);
    if (text == "max")
        return 0;
    if (ok && number >= low && number <= high)
        return number;
    return failure(ErrorKind::InvalidArgument,
                   QStringLiteral("%1: \"%2\" is not a number from %3 to %4, nor max")
                       .arg(QString::fromLatin1(option), QString::fromStdString(text))
                       .arg(low)
                       .arg(high, 0, 'f', 0));
}

void describeConvert(CLI::App &app, RecordArguments &typed)
{
    CLI::App *convert = app.add_subcommand("convert", "Make another file of a recording: CSV of MCAP, or MCAP anew, "
                                                      "which gives one that was cut off its index");
    convert->add_option("IN", typed.input, "A recording, .mcap")->required()->type_name({});
    convert->add_option("OUT", typed.output, "The new file, .csv or .mcap")->required()->type_name({});
}

} // namespace

Result<RecordOptions> RecordArguments::understand() const
{
    const auto pace = numberOrMax("--rate", rate, 0.001, 100'000);
    if (!pace)
        return tl::unexpected(pace.error());
    const auto times = numberOrMax("--speed", speed, 0.001, 1000);
    if (!times)
        return tl::unexpected(times.error());
    RecordOptions options;
    options.input = QString::fromStdString(input);
    options.output = QString::fromStdString(output);
    options.name = QString::fromStdString(name);
    options.note = QString::fromStdString(note);
    options.udp = QString::fromStdString(udp);
    options.rate = *pace;
    options.speed = *times;
    options.splitMegabytes = splitMegabytes.value_or(0);
    options.splitMinutes = splitMinutes.value_or(0);
    options.from = from.value_or(0);
    if (const QString &file = options.output; !file.isEmpty()) {
        if (!file.endsWith(u".mcap") && !file.endsWith(u".csv"))
            return failure(ErrorKind::InvalidArgument, QStringLiteral("%1: a recording ends in .mcap or .csv").arg(file));
    }
    return options;
}

void describeRecordings(CLI::App &app, Typed &typed)
{
    RecordArguments &arguments = typed.record;
    CLI::App *record = app.add_subcommand("record", "Write what registers hold to a file, until Ctrl-C");
    record->add_option("FIELD", typed.registers, "By its name in the control table")->required()->type_name({});
    record->add_option("--ids", typed.idList, "The devices: 1,4-7 (whoever a scan finds)")->type_name("LIST");
    record->add_option("-o,--output", arguments.output, "The file, .mcap or .csv (PORT_DATE_TIME.mcap in this folder)")
        ->type_name("FILE");
    record->add_option("--rate", arguments.rate, "Samples a second, or max: as many as the line carries (max)")
        ->type_name("N");
    record->add_option("--seconds,--for", typed.seconds, "End after that long")
        ->type_name("N")
        ->check(CLI::Range(0.01, 1e6).description({}));
    record->add_option("--name", arguments.name, "What the robot is called")->type_name("TEXT");
    record->add_option("--note", arguments.note, "Goes into the recording")->type_name("TEXT");
    record->add_option("--split-mb", arguments.splitMegabytes, "A new file each so many megabytes")
        ->type_name("N")
        ->check(CLI::Range(0.1, 1e6).description({}));
    record->add_option("--split-min", arguments.splitMinutes, "A new file each so many minutes")
        ->type_name("N")
        ->check(CLI::Range(0.01, 1e5).description({}));
    record->add_option("--udp", arguments.udp, UdpHelp)->type_name("PLACE");
    record->footer("A recording holds the whole control table of each device as it was at the begin. What was read is on "
                   "the disk a second later, whatever happens to the program.");

    CLI::App *replay = app.add_subcommand("replay", "Print a recording as watch would have, or send it on");
    replay->add_option("FILE", arguments.input, "A recording, .mcap")->required()->type_name({});
    replay->add_option("--speed", arguments.speed, "So many times as fast, or max: without waiting (1)")->type_name("N");
    replay->add_option("--from", arguments.from, "Begin so many seconds after its begin")
        ->type_name("N")
        ->check(CLI::Range(0.0, 1e9).description({}));
    replay->add_option("--count", typed.count, "End after that many samples")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000'000).description({}));
    replay->add_flag("--csv", typed.csv, "Comma-separated values in the units of the heading");
    replay->add_option("--udp", arguments.udp, std::string(UdpHelp) + ", instead of printing it")->type_name("PLACE");
    describeConvert(app, arguments);
}

} // namespace dynascope::dxl
