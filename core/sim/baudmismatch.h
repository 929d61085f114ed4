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

/// The wire's level at this moment of bytes sent back to back, in bit times from their begin; high before and after.
bool wireLevel(ByteView bytes, double bit);

/// A byte that a UART at the sender's rate makes of `bytes` when it begins to listen in their middle, and the byte sent in
/// which its stop bit falls.
struct LateByte {
    std::uint8_t byte = 0;
    std::size_t endsIn = 0;
};
std::vector<LateByte> heardFromWithin(ByteView bytes, double firstBit);

} // namespace dynascope::sim
