// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

namespace dynascope {

/// CRC-16 of Protocol 2.0: polynomial 0x8005, not reflected, no final XOR. `seed` continues an earlier sum.
/// Manual: "CRC calculation".
std::uint16_t crc16(ByteView data, std::uint16_t seed = 0);

} // namespace dynascope
