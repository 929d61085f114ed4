// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dynascope::sim {

/// The rate that the client of this pseudo-terminal has set, odd ones too; 0 where it can't be told. In a source of its
/// own because <asm/termbits.h> clashes with <termios.h>.
int clientBaudRate(int masterDescriptor);

} // namespace dynascope::sim
