// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/scan.h"
#include "core/table/controltable.h"

namespace dynascope {

/// What tells two alike devices of this table apart: Realtime Tick to Present Temperature, as far as they stand
/// together. Nothing where the table has no such register. Pure.
std::optional<VolatileSpan> volatileSpanOf(const ControlTable &table);

/// The same, of a servo that is known to rest: Present Position, temperature and input voltage may hardly change from
/// one read to the next. Would mistake one that moves by itself for two.
std::optional<VolatileSpan> restingSpanOf(const ControlTable &table);

} // namespace dynascope
