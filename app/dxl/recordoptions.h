// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QString>

#include <optional>
#include <string>

namespace dynascope::dxl {

/// What `dxl record`, `convert` and `replay` were told besides devices and registers.
struct RecordOptions {
    QString input;        ///< convert, replay
    QString output;       ///< record, convert; empty with record: one is named automatically
    QString name, note;   ///< record
    double rate = 0;      ///< record: samples a second; 0: as many as the line carries
    double splitMegabytes = 0, splitMinutes = 0; ///< record; 0: one file
    QString udp;          ///< record, replay: where samples are sent to; empty: nowhere
    double speed = 1;     ///< replay; 0: without waiting
    double from = 0;      ///< replay: seconds
};

/// Of the command line as typed.
struct RecordArguments {
    std::string input, output, name, note, udp, rate = "max", speed = "1";
    std::optional<double> splitMegabytes, splitMinutes, from;

    Result<RecordOptions> understand() const;
};

} // namespace dynascope::dxl
