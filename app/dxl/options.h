// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/backupoptions.h"
#include "app/dxl/commissionoptions.h"
#include "app/dxl/journaloptions.h"
#include "app/dxl/modelsarguments.h"
#include "app/dxl/moveoptions.h"
#include "app/dxl/profileoptions.h"
#include "app/dxl/recordoptions.h"
#include "app/dxl/simoptions.h"
#include "core/protocol/protocol_values.h"

#include <optional>
#include <vector>

namespace dynascope::dxl {

enum class ExitCode {
    Done = 0,
    Failed = 1,        ///< a device or the line
    Usage = 2,         ///< nothing was written
    Unconfirmed = 3,   ///< sent, and nothing says that it arrived
    Interrupted = 130, ///< Ctrl-C, SIGTERM, or the terminal was closed; as a shell says it of SIGINT
    Unread = 141,      ///< nobody reads standard output any more; as a shell says it of SIGPIPE
};

enum class Command {
    Backup,
    Clear,
    Commission,
    Compare,
    Completion,
    Convert,
    Info,
    Journal,
    Led,
    Models,
    Move,
    Packet,
    Ping,
    Ports,
    Profile,
    Read,
    Reboot,
    Record,
    Replay,
    Reset,
    Restore,
    Scan,
    Sim,
    Stats,
    Stop,
    Table,
    Torque,
    Version,
    Watch,
    Write,
};

/// Of the documents that --json writes: README, "JSON". Grows when a program written for the last one would be misled.
constexpr int JsonVersion = 1;

/// What the command line says, checked as far as that goes without a device.
struct Options {
    Command command = Command::Ping;
    QString port;         ///< empty: the one adapter that is there
    int baudRate = 57600; ///< bits per second
    std::optional<int>
        timeout; ///< ms that an answer may come late on account of the host; nothing: by the kind of port
    bool json = false;
    bool verbose = false; ///< every packet to standard error
    /// The devices, ascending. Empty with `stats`, `stop`: whoever a scan finds.
    std::vector<std::uint8_t> idList;
    std::vector<RegisterArgument> registers; ///< read, write, stats, watch
    // scan, stop
    std::vector<int> bauds;
    IdRange ids{0, 252};
    bool sweep = false; ///< scan: one Ping after the other
    QString model;      ///< stop: what all of idList are
    // write
    bool explain = false;    ///< say what it would bring, and write nothing
    bool safely = false;     ///< the safe way
    bool torqueBack = false; ///< with it: torque on again where it was
    // stats, watch
    std::optional<double> seconds;
    std::optional<int> count; ///< watch: samples
    double rate = 10;         ///< watch: samples a second; 0: as many as the line carries
    bool csv = false;         ///< watch
    // torque, led
    bool on = false;
    // reset, clear
    ResetOption reset = ResetOption::AllButIdAndBaud;
    ClearOption clear = ClearOption::Position;
    bool yes = false; ///< was asked and agreed
    // packet
    Bytes packet;              ///< as it goes out
    std::optional<int> listen; ///< ms
    // completion
    QString shell;
    BackupOptions backup; ///< backup, restore, compare
    ModelsArguments models;
    SimOptions sim;
    JournalOptions journal;
    MoveOptions move;
    CommissionWishes commission;
    ProfileOptions profile;
    RecordOptions record;
};

/// Where there is nothing to do (--help, --version: Done) or it makes no sense (Usage), that has been printed.
tl::expected<Options, ExitCode> parseOptions(int argc, const char *const *argv);

} // namespace dynascope::dxl
