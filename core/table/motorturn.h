// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <optional>

namespace dynascope {

/// What a model with a gearbox in front of its joint counts: ControlTable::resolution() is both together.
struct MotorTurn {
    int pulses = 0;       ///< a turn of the motor, before the gears
    double gearRatio = 1; ///< turns of the motor for one of the joint
};

/// Nothing of models whose table states no gears, and of those that turn what they carry themselves.
std::optional<MotorTurn> motorTurn(const ControlTable &table);

} // namespace dynascope
