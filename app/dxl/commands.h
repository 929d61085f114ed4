// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/connection.h"
#include "app/dxl/options.h"
#include "app/dxl/output.h"
#include "core/table/catalog.h"

namespace dynascope {
class Journal;
class MoveFile;
}

namespace dynascope::dxl {

/// What a command on a line works with.
struct Work {
    const Options &options;
    const Catalog &catalog;
    Bus &bus;
    Output &output;
    Journal &journal; ///< every write is noted there
};

/// @name Commands on a line. They print results and failures themselves.
/// @{
ExitCode backupCommand(const Work &work);
ExitCode clearCommand(const Work &work);
ExitCode commissionCommand(const Work &work);
ExitCode compareCommand(const Work &work);
ExitCode infoCommand(const Work &work);
ExitCode moveCommand(const Work &work);
ExitCode packetCommand(const Work &work);
ExitCode pingCommand(const Work &work);
ExitCode profileCommand(const Work &work);
ExitCode profileSaveCommand(const Work &work); ///< the part of it that writes the file
ExitCode readCommand(const Work &work);
ExitCode rebootCommand(const Work &work);
ExitCode recordCommand(const Work &work);
ExitCode resetCommand(const Work &work);
ExitCode restoreCommand(const Work &work);
ExitCode scanCommand(const Work &work);
ExitCode statsCommand(const Work &work);
ExitCode stopCommand(const Work &work);
ExitCode switchCommand(const Work &work); ///< torque, led
ExitCode tableCommand(const Work &work);
ExitCode watchCommand(const Work &work);
ExitCode writeCommand(const Work &work);
/// @}

/// Could the moves of its options be carried out? Everything is looked at, nothing written.
Result<void> checkMove(const Work &work);
/// Where a plan of moves on this line is kept.
MoveFile moveFileOf(const Options &options);

/// Of two files, without a line.
ExitCode compareFilesCommand(const Catalog &catalog, const Options &options, Output &output);
ExitCode completionCommand(const Catalog &catalog, const Options &options, Output &output);
/// Of a recording, without a line.
ExitCode convertCommand(const Options &options, Output &output);
ExitCode replayCommand(const Options &options, Output &output);
ExitCode journalCommand(const Catalog &catalog, Options options, Output &output);
ExitCode portsCommand(Output &output);
ExitCode versionCommand(Output &output);
/// Serves the bus until the program is interrupted.
ExitCode simCommand(const Catalog &catalog, const Options &options, Output &output);

} // namespace dynascope::dxl
