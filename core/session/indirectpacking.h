// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

#include <functional>
#include <optional>

namespace dynascope {

/// Scattered registers of one device as one stretch of Indirect Data: which Indirect Addresses are to be set for it,
/// and where each register then stands. A value; manual, "Indirect Address".
struct IndirectPacking {
    struct Entry {
        int field = -1;           ///< the Indirect Address, index in the table
        std::int64_t before = 0;  ///< what it holds, to be put back
        std::int64_t to = 0;
    };
    struct Place {
        int field = -1; ///< a packed register, index in the table
        int offset = 0; ///< of its first byte in the stretch
    };
    std::vector<Entry> entries; ///< one a byte
    std::vector<Place> places;
    std::uint16_t address = 0, length = 0; ///< of the Indirect Data to read
    /// The last byte shows a byte of the address register that it is read by, never 0: after a restart, when every
    /// entry points at its own data again, it doesn't. −1: there is none.
    int mark = -1;
    int bytesSpared = 0;                   ///< of those that reading from the first register to the last would take

    std::vector<int> fields() const; ///< that are packed, in the order of the stretch
    /// Where `field` is now to be read; −1: it isn't packed.
    int addressOf(int field) const;
    /// Do these bytes, as read, come by way of the entries?
    bool isThrough(ByteView data) const;
};

bool isSettableEntry(const Field &field); ///< an Indirect Address in RAM
bool mayBePointedAt(const Field &field);

enum class UsedEntries { Refuse, Take };
enum class PackingMark { None, Last };

/// Entries that hold something other than their initial value are somebody else's, and are taken only where a person
/// said so. `known` gives what an Indirect Address holds. Fails with NotSupported where the model has none,
/// InvalidArgument where a register can't be pointed at (EEPROM, Indirect Data itself) or is named twice, NotFound
/// where what an entry holds isn't known or too few are free in a row. Pure.
Result<IndirectPacking> packIndirect(const ControlTable &table, const std::vector<int> &fields,
                                     const std::function<std::optional<std::int64_t>(int field)> &known,
                                     UsedEntries used = UsedEntries::Refuse, PackingMark mark = PackingMark::None);
/// With a mark, and only where it spares more than a byte a read and no entry lasts beyond power-off; else NotSupported.
Result<IndirectPacking> packWorthwhile(const ControlTable &table, const std::vector<int> &fields,
                                       const std::function<std::optional<std::int64_t>(int field)> &known,
                                       UsedEntries used);

} // namespace dynascope
