// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

namespace dynascope::sim {

/// UARTs take each other's bytes for good up to this difference; reference "The line".
constexpr double BaudTolerance = 0.03;

bool understandEachOther(int baudRate, int otherBaudRate);

/// What a UART at `to` bits per second makes of bytes sent back to back at `from`: the signal's bits, sampled at the
/// wrong times. A byte without a stop bit is lost.
Bytes heardAtOtherBaud(ByteView bytes, int from, int to);

} // namespace dynascope::sim
