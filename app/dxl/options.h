// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/arguments.h"
#include "app/dxl/simoptions.h"

#include <vector>

namespace dynascope::dxl {

enum class ExitCode {
    Done = 0,
    Failed = 1,      ///< a device or the line
    Usage = 2,       ///< nothing was written
    Unconfirmed = 3, ///< sent to a device that was told never to answer
};

enum class Command { Scan, Ping, Read, Write, Stats, Sim };

/// What the command line says, checked as far as that goes without a device.
struct Options {
    Command command = Command::Ping;
    QString port;
    int baudRate = 57600; ///< bits per second
    bool json = false;
    bool verbose = false; ///< every packet to standard error
    // scan
    std::vector<int> bauds;
    IdRange ids{0, 252};
    bool sweep = false; ///< scan: one Ping after the other
    // ping, read, write
    std::uint8_t id = 0;
    std::vector<RegisterArgument> registers;
    // stats, with `registers`
    double seconds = 10;
    std::vector<std::uint8_t> idList; ///< who should be there; empty: whoever a scan finds
    SimOptions sim;
};

/// Where there is nothing to do (--help, --version: Done) or it makes no sense (Usage), that has been printed.
tl::expected<Options, ExitCode> parseOptions(int argc, const char *const *argv);

} // namespace dynascope::dxl
