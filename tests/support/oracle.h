// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

/// Protocol 2.0 written a second time, straight from the manual and as plainly as possible, sharing no code with core:
/// what core is compared with. Keep it slow and obvious.
namespace oracle {

using Bytes = std::vector<std::uint8_t>;

std::uint16_t crc(const Bytes &bytes); ///< bit by bit
Bytes stuff(const Bytes &body);
/// The inverse, by search: the only body whose stuffed form these bytes are; empty `found` where there is none.
Bytes unstuff(const Bytes &stuffed, bool *found);
Bytes instruction(std::uint8_t id, std::uint8_t code, const Bytes &parameters);
Bytes status(std::uint8_t id, std::uint8_t error, const Bytes &parameters);

} // namespace oracle
