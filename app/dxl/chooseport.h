// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"

namespace dynascope::dxl {

/// The port to use where none was named: the one adapter that is there. A board's own ports are not taken unasked.
/// Fails with InvalidArgument and lists what there is.
Result<QString> choosePort(const std::vector<PortInfo> &ports);

/// "/dev/ttyUSB0  USB Serial Converter (FTDI), serial number FT1".
QString portText(const PortInfo &port);

} // namespace dynascope::dxl
