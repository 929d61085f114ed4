// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

namespace dynascope {

/// What is typed into a cell of the grid, and what the cell says of a raw value. Values, so that it may outlive device
/// and table.
struct ValueMeaning {
    Field field;
    EffectiveField effective;
    int resolution = 4096; ///< pulses per revolution
    UnitPreferences units;
    bool physical = false;                ///< said with its unit, and a bare number is meant in that, not raw
    ControlTablePtr pointsInto = nullptr; ///< of an Indirect Address: registers are named, bare numbers are addresses

    QString text(std::int64_t raw) const; ///< as the cell does
    QString said(std::int64_t raw) const; ///< with name or unit, whatever the cell does
    /// Of every text that text() makes of an allowed value: that value.
    Result<std::int64_t> value(const QString &typed) const;
};

} // namespace dynascope
