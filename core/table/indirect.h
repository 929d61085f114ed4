// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

namespace dynascope {

/// The n of "Indirect Address n" and "Indirect Data n": the data shows the byte that the address of its number points at
/// (manual, "Indirect Address"). 0 for other registers.
int indirectAddressNumber(const Field &field);
int indirectDataNumber(const Field &field);
/// The address register of this Indirect Data; −1 where the table has none.
int indirectAddressOf(const ControlTable &table, const Field &data);

/// "LED", "Present Position, byte 2", or the number where no register is. parseAddress() makes the address of it.
QString addressText(const ControlTable &table, std::int64_t address);
/// What a person typed for an address: a number (decimal or 0x…), or a register, perhaps with a byte of it ("Present
/// Position, byte 2", "Present Position + 2"). Not checked against a range.
Result<std::int64_t> parseAddress(const ControlTable &table, QStringView text);

/// Registers of one name that are numbered one after the other, so many that nobody reads them all: indirect blocks,
/// histories, bytes of a table.
struct FieldRun {
    QString name;            ///< without the number
    int first = 0, last = 0; ///< indices in the table
    int firstNumber = 0;

    int count() const { return last - first + 1; }
};
/// By index. No field is in two of them.
std::vector<FieldRun> longRuns(const ControlTable &table);

} // namespace dynascope
