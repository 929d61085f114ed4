// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"
#include "core/table/controltable.h"

namespace dynascope::test {

/// Going through all that a device of some model can do with its registers, over whatever line the Bus is on. An error
/// is of the line, as it came, or NotConfirmed: the device has another value than it should.

/// Every register, neighbours together: the image, by address. EEPROM must be as it left the factory.
Result<Bytes> readWhole(Bus &bus, std::uint8_t id, const ControlTable &table);

/// The writable registers of which no earlier one has the same area, size, sign and way of having names. Without those
/// whose write does more than change a value: they have tests of their own.
std::vector<const Field *> oneOfEachKind(const ControlTable &table);

/// Another value than it has in `image`, as its range allows it there; `image` then has it.
Result<void> writeAndReadBack(Bus &bus, std::uint8_t id, const ControlTable &table, const Field &field, Bytes &image);

} // namespace dynascope::test
