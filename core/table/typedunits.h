// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/field.h"

#include <numbers>

namespace dynascope {

/// A unit a person may type, and how many of the field's own unit (degrees for positions) it is.
struct TypedUnit {
    const char16_t *text;
    Unit unit;
    double factor;
};

inline constexpr double DegreesPerRadian = 180.0 / std::numbers::pi;

/// Compared in lower case and without spaces. The first of each unit are the ones that messages offer.
inline constexpr TypedUnit TypedUnits[] = {
    {u"deg", Unit::Pulse, 1.0},
    {u"rad", Unit::Pulse, DegreesPerRadian},
    {u"turn", Unit::Pulse, 360.0},
    {u"°", Unit::Pulse, 1.0},
    {u"degree", Unit::Pulse, 1.0},
    {u"degrees", Unit::Pulse, 1.0},
    {u"turns", Unit::Pulse, 360.0},
    {u"rev", Unit::Pulse, 360.0},
    {u"rpm", Unit::RevPerMin, 1.0},
    {u"deg/s", Unit::RevPerMin, 1.0 / 6.0},
    {u"rad/s", Unit::RevPerMin, DegreesPerRadian / 6.0},
    {u"rev/min", Unit::RevPerMin, 1.0},
    {u"°/s", Unit::RevPerMin, 1.0 / 6.0},
    {u"rev/s", Unit::RevPerMin, 60.0},
    {u"rev/min2", Unit::RevPerMin2, 1.0},
    {u"deg/s2", Unit::RevPerMin2, 10.0},
    {u"rad/s2", Unit::RevPerMin2, 10.0 * DegreesPerRadian},
    {u"rev/min²", Unit::RevPerMin2, 1.0},
    {u"rev/min^2", Unit::RevPerMin2, 1.0},
    {u"rpm2", Unit::RevPerMin2, 1.0},
    {u"rpm²", Unit::RevPerMin2, 1.0},
    {u"deg/s²", Unit::RevPerMin2, 10.0},
    {u"°/s²", Unit::RevPerMin2, 10.0},
    {u"deg/s^2", Unit::RevPerMin2, 10.0},
    {u"rad/s²", Unit::RevPerMin2, 10.0 * DegreesPerRadian},
    {u"rad/s^2", Unit::RevPerMin2, 10.0 * DegreesPerRadian},
    {u"mA", Unit::MilliAmpere, 1.0},
    {u"A", Unit::MilliAmpere, 1000.0},
    {u"A", Unit::Ampere, 1.0},
    {u"mA", Unit::Ampere, 0.001},
    {u"%", Unit::Percent, 1.0},
    {u"percent", Unit::Percent, 1.0},
    {u"V", Unit::Volt, 1.0},
    {u"mV", Unit::Volt, 0.001},
    {u"°C", Unit::Celsius, 1.0},
    {u"C", Unit::Celsius, 1.0},
    {u"degC", Unit::Celsius, 1.0},
    {u"us", Unit::Microsecond, 1.0},
    {u"ms", Unit::Microsecond, 1000.0},
    {u"s", Unit::Microsecond, 1e6},
    {u"ms", Unit::Millisecond, 1.0},
    {u"s", Unit::Millisecond, 1000.0},
    {u"us", Unit::Millisecond, 0.001},
    {u"mV/ms", Unit::MilliVoltPerMs, 1.0},
    {u"V/s", Unit::MilliVoltPerMs, 1.0},
    {u"Hz", Unit::Hertz, 1.0},
    {u"kHz", Unit::Hertz, 1000.0},
    {u"deg/s", Unit::PulsePerSec, 1.0},
    {u"rad/s", Unit::PulsePerSec, DegreesPerRadian},
    {u"rpm", Unit::PulsePerSec, 6.0},
    {u"°/s", Unit::PulsePerSec, 1.0},
    {u"turn/s", Unit::PulsePerSec, 360.0},
    {u"rev/s", Unit::PulsePerSec, 360.0},
    {u"rev/min", Unit::PulsePerSec, 6.0},
};

} // namespace dynascope
