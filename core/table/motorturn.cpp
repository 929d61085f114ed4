// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/motorturn.h"

#include <cmath>

namespace dynascope {

std::optional<MotorTurn> motorTurn(const ControlTable &table)
{
    const Field *position = table.find(Known::PresentPosition);
    // Devices leave the factory counting turns of the joint: their Electronic GearRatio is that of the gears.
    if (!position || !position->gearRatio.isSet() || position->gearRatio.initialTurns >= 1)
        return std::nullopt;
    const double turns = position->gearRatio.initialTurns;
    constexpr double Exact = 1e6; // it is a quotient of two registers: 51, not 51.000000000000007
    return MotorTurn{static_cast<int>(std::lround(table.resolution() * turns)), std::round(Exact / turns) / Exact};
}

} // namespace dynascope
