// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own: <asm/termbits.h>, which has the odd rates, clashes with <termios.h>.
#include "core/bus/serialport_posix.h"

#ifdef __linux__
#include <asm/termbits.h>
#include <sys/ioctl.h>
#endif

namespace dynascope::posix {

std::optional<int> actualBaudRate(int descriptor)
{
#ifdef __linux__
    termios2 settings{};
    if (::ioctl(descriptor, TCGETS2, &settings) != 0)
        return std::nullopt;
    return static_cast<int>(settings.c_ospeed);
#else
    (void)descriptor;
    return std::nullopt;
#endif
}

} // namespace dynascope::posix
