// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/connection.h"
#include "app/dxl/options.h"
#include "app/dxl/output.h"
#include "core/table/catalog.h"

namespace dynascope::dxl {

/// What a command on a line works with.
struct Work {
    const Options &options;
    const Catalog &catalog;
    Bus &bus;
    Output &output;
};

ExitCode scanCommand(const Work &work);
ExitCode pingCommand(const Work &work);
ExitCode readCommand(const Work &work);
ExitCode writeCommand(const Work &work);
/// Polls for a while, or until the program is interrupted, and reports.
ExitCode statsCommand(const Work &work);

/// Serves the bus until the program is interrupted.
ExitCode simCommand(const Catalog &catalog, const Options &options, Output &output);

} // namespace dynascope::dxl
