// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/crc16.h"

#include <array>

namespace dynascope {
namespace {

constexpr std::array<std::uint16_t, 256> makeTable()
{
    std::array<std::uint16_t, 256> table{};
    for (unsigned i = 0; i < 256; ++i) {
        unsigned crc = i << 8;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 0x8000U) ? ((crc << 1) ^ 0x8005U) : (crc << 1);
        table[i] = static_cast<std::uint16_t>(crc);
    }
    return table;
}

constexpr auto Table = makeTable();

} // namespace

std::uint16_t crc16(ByteView data, std::uint16_t seed)
{
    std::uint16_t crc = seed;
    for (const std::uint8_t byte : data)
        crc = static_cast<std::uint16_t>((crc << 8) ^ Table[((crc >> 8) ^ byte) & 0xFFU]);
    return crc;
}

} // namespace dynascope
