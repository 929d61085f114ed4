// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dynascope {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Appends the low `size` bytes of `value`, low byte first, as every register and length on the wire is.
inline void appendLittleEndian(Bytes &to, std::uint32_t value, int size)
{
    for (int i = 0; i < size; ++i)
        to.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// The first `size` (0..4) bytes of `from`, low byte first. `from` must hold that many.
inline std::uint32_t littleEndian(ByteView from, int size)
{
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i)
        value |= static_cast<std::uint32_t>(from[static_cast<std::size_t>(i)]) << (8 * i);
    return value;
}

} // namespace dynascope
