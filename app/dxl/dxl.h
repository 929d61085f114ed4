// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// `dxl`, the command line tool: finds, reads and writes servos on one line, and serves a simulated bus.
namespace dynascope::dxl {

/// Does what the arguments say. The program's exit code: see ExitCode.
int run(int argc, const char *const *argv);

} // namespace dynascope::dxl
