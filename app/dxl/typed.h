// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/options.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

/// The command line as typed, before our own languages are read.
struct Typed {
    std::string port, scanIds = "0-252";
    std::optional<std::string> bauds, idList, model, hex;
    std::optional<double> seconds;
    std::optional<int> timeout, count, listen;
    std::string ids, state, option, shell, rate = "10", json;
    int baudRate = 57600;
    bool verbose = false;
    bool sweep = false;
    bool csv = false;
    bool yes = false;
    bool raw = false;
    bool explain = false, safely = false, torqueBack = false;
    std::vector<std::string> registers, words;
    BackupArguments backup;
    SimArguments sim;
    ModelsArguments models;
    JournalArguments journal;
    MoveArguments move;
    CommissionArguments commission;
    ProfileArguments profile;
    RecordArguments record;
};

/// The one description of commands and options: what is parsed, helped with, completed and checked against the manual
/// page. `typed` outlives `app`.
void describe(CLI::App &app, Typed &typed);

/// @name Parts of it
/// @{
void describeFinding(CLI::App &app, Typed &typed);   ///< ports, scan, ping, info
void describeRegisters(CLI::App &app, Typed &typed); ///< table, read, write, watch, stats
void describeActions(CLI::App &app, Typed &typed);   ///< torque, led, reboot, reset, clear, stop
void describePacket(CLI::App &app, Typed &typed);
void describeRecordings(CLI::App &app, Typed &typed); ///< record, replay, convert
void addIds(CLI::App &command, Typed &typed); ///< the devices, as a positional argument
/// @}

/// The command of this name, as the description has it.
Command commandNamed(const std::string &name);

} // namespace dynascope::dxl
