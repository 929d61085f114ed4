// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <set>

namespace dynascope {

/// How the registers of a table are grouped: by area, long runs of like ones (indirect.h) for themselves.
struct FieldGroup {
    QString title;
    bool folded = false;     ///< as long as nobody opened it
    bool isRun = false;      ///< many alike: folded ones aren't polled, and say how many they are
    std::vector<int> fields; ///< indices in the table, by address
};
std::vector<FieldGroup> fieldGroups(const ControlTable &table);

/// Registers that others take their range, unit, meaning or lock from: when one changes, everything may look different.
std::set<int> decidingFields(const ControlTable &table);

} // namespace dynascope
