// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// `dxl`, the command line tool: finds, reads and writes servos on one line, and serves a simulated bus.
namespace dynascope::dxl {

/// Does what the arguments say. The program's exit code: 0 done, 1 a device or the line failed, 2 wrong usage.
int run(int argc, const char *const *argv);

} // namespace dynascope::dxl
