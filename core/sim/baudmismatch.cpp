// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/baudmismatch.h"

#include <cmath>

namespace dynascope::sim {
namespace {

constexpr std::size_t BitsPerByte = 10; ///< start, 8 data low bit first, stop

/// A UART at `bit` sender's bit times a bit, from `at` on.
std::vector<LateByte> listen(ByteView bytes, double bit, double at)
{
    const auto end = static_cast<double>(bytes.size() * BitsPerByte);
    const auto nextBit = [](double time) { return std::floor(time) + 1; }; // the level stays until then
    std::vector<LateByte> heard;
    while (at < end) {
        if (wireLevel(bytes, at)) { // waits for a start bit
            at = nextBit(at);
            continue;
        }
        std::uint8_t byte = 0;
        for (unsigned i = 0; i < 8; ++i)
            byte |= static_cast<std::uint8_t>(wireLevel(bytes, at + bit * (1.5 + i)) ? 1U << i : 0U);
        const double stop = at + bit * 9.5;
        if (wireLevel(bytes, stop))
            heard.push_back({byte, static_cast<std::size_t>(stop) / BitsPerByte});
        at = stop;
        while (at < end && !wireLevel(bytes, at)) // a missing stop bit: waits until the wire is high again
            at = nextBit(at);
    }
    return heard;
}

} // namespace

bool wireLevel(ByteView bytes, double bit)
{
    const auto index = static_cast<std::size_t>(bit);
    const std::size_t byte = index / BitsPerByte;
    const std::size_t within = index % BitsPerByte;
    if (bit < 0 || byte >= bytes.size() || within == BitsPerByte - 1)
        return true;
    return within != 0 && ((bytes[byte] >> (within - 1)) & 1) != 0;
}

bool understandEachOther(int baudRate, int otherBaudRate)
{
    return std::abs(baudRate - otherBaudRate) <= BaudTolerance * otherBaudRate;
}

Bytes heardAtOtherBaud(ByteView bytes, int from, int to)
{
    Bytes heard;
    for (const LateByte &one : listen(bytes, static_cast<double>(from) / to, 0))
        heard.push_back(one.byte);
    return heard;
}

std::vector<LateByte> heardFromWithin(ByteView bytes, double firstBit)
{
    return listen(bytes, 1, firstBit);
}

} // namespace dynascope::sim
