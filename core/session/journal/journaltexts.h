// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalentry.h"

#include <span>

/// The journal in words, for window, `dxl` and scripts. Pure.
namespace dynascope {

class Catalog;

/// "Position control", "90.00 °", or the raw number; "?" where it isn't known.
QString valueText(const Catalog &catalog, const JournalDevice &device, const RegisterChange &change,
                  const Bytes &value);
/// "Operating Mode", "Operating Mode and 9 more", "reboot"
QString whatText(const JournalEntry &entry);
/// "3 → 1"; of an entry that is no write its note.
QString changeText(const Catalog &catalog, const JournalEntry &entry);

/// A shell script of `dxl` that writes the same once more, in the order of the journal. What would switch torque on,
/// and what can't be repeated, stands there as a comment. Nothing in an entry reaches the shell unquoted.
QString scriptOf(std::span<const JournalEntry> entries);

} // namespace dynascope
