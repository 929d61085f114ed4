// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/baudmismatch.h"

#include <cmath>

namespace dynascope::sim {
namespace {

constexpr std::size_t BitsPerByte = 10; ///< start, 8 data low bit first, stop

/// The level of the wire in the sender's bit times; high behind the end.
bool level(ByteView bytes, double bit)
{
    const auto index = static_cast<std::size_t>(bit);
    const std::size_t byte = index / BitsPerByte;
    const std::size_t within = index % BitsPerByte;
    if (byte >= bytes.size() || within == BitsPerByte - 1)
        return true;
    return within != 0 && ((bytes[byte] >> (within - 1)) & 1) != 0;
}

} // namespace

bool understandEachOther(int baudRate, int otherBaudRate)
{
    return std::abs(baudRate - otherBaudRate) <= BaudTolerance * otherBaudRate;
}

Bytes heardAtOtherBaud(ByteView bytes, int from, int to)
{
    const double bit = static_cast<double>(from) / to; // the listener's bit time in the sender's
    const auto end = static_cast<double>(bytes.size() * BitsPerByte);
    const auto nextBit = [](double time) { return std::floor(time) + 1; }; // the level stays until then
    Bytes heard;
    double at = 0;
    while (at < end) {
        if (level(bytes, at)) { // waits for a start bit
            at = nextBit(at);
            continue;
        }
        std::uint8_t byte = 0;
        for (unsigned i = 0; i < 8; ++i)
            byte |= static_cast<std::uint8_t>(level(bytes, at + bit * (1.5 + i)) ? 1U << i : 0U);
        const double stop = at + bit * 9.5;
        if (level(bytes, stop))
            heard.push_back(byte);
        at = stop;
        while (at < end && !level(bytes, at)) // a missing stop bit: waits until the wire is high again
            at = nextBit(at);
    }
    return heard;
}

} // namespace dynascope::sim
