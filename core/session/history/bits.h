// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtEndian>

#include <cstddef>
#include <cstdint>

namespace dynascope::bits {

// Numbers of 0..57 or just 64 bits, one behind the other. One of 64 begins at a whole byte. Behind the last bit lie
// `Spare` more bytes: each number is read as eight bytes at once.

constexpr std::size_t Spare = 8;
constexpr unsigned Widest = 57;

inline std::uint64_t mask(unsigned width)
{
    return width >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << width) - 1;
}

inline std::uint64_t read(const std::byte *from, std::size_t bit, std::uint64_t mask)
{
    return (qFromLittleEndian<quint64>(from + bit / 8) >> (bit % 8)) & mask;
}

/// Into bits that are zero.
inline void write(std::byte *to, std::size_t bit, std::uint64_t value)
{
    std::byte *word = to + bit / 8;
    qToLittleEndian<quint64>(qFromLittleEndian<quint64>(word) | value << (bit % 8), word);
}

} // namespace dynascope::bits
