// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ptybaud.h"

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace dynascope::sim {

int clientBaudRate(int masterDescriptor)
{
    termios2 settings{};
    return ioctl(masterDescriptor, TCGETS2, &settings) == 0 ? static_cast<int>(settings.c_ospeed) : 0;
}

} // namespace dynascope::sim
