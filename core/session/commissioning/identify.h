// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionround.h"

namespace dynascope {

/// Lights the LED, waits, puts it out. Registers "LED", or of models with a coloured one each colour's. NotSupported:
/// the model has none.
Result<void> identifyByLed(
    JobContext &context, const Found &device, const ControlTable &table, const CommissionHooks &hooks = {});
bool hasLed(const ControlTable &table);

} // namespace dynascope
