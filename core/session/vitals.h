// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "core/table/units.h"

#include <array>

namespace dynascope {

/// What tells at a glance how a device is.
enum class Vital { Position, Load, Temperature, Voltage, Error };
constexpr int VitalCount = 5;

/// Where a limit comes from.
enum class LimitSource {
    None,   ///< there is none, or it is zero, which bounds nothing
    Table,  ///< what the model leaves the factory with: the device's own register has not been read yet
    Device, ///< its register as it was read
};

/// One end of what a value may be.
struct VitalLimit {
    double value = 0; ///< in the unit of the value
    LimitSource source = LimitSource::None;
    QString name; ///< the register's

    bool isKnown() const { return source != LimitSource::None; }
    friend bool operator==(const VitalLimit &, const VitalLimit &) = default;
};

struct VitalReading {
    int field = -1;                  ///< of the device's table; −1: its model has none
    std::optional<std::int64_t> raw; ///< nothing: never read, or too old to say anything
    LineTime at{};                   ///< when it was read
    Physical value;                  ///< of `raw`
    VitalLimit low, high;
};

/// The registers of a table that say it. Where a model has several (Y: inverter and motor), each with its limit. Pure.
struct VitalField {
    Vital vital = Vital::Position;
    int field = -1;
    int low = -1, high = -1; ///< registers that bound it; −1: none is known
};
std::vector<VitalField> vitalFields(const ControlTable &table);
bool isVital(const Field &field, Vital vital);

/// How a device is, as far as is known. A value, for any thread.
struct Vitals {
    std::array<VitalReading, VitalCount> readings; ///< by Vital
    bool isThere = false;                          ///< it answers, and its line is open
    bool isSilent = false;                         ///< it should answer, and doesn't
    QString errors;                                ///< what its error register means; empty: none, or not known

    const VitalReading &operator[](Vital vital) const { return readings[static_cast<std::size_t>(vital)]; }
    VitalReading &operator[](Vital vital) { return readings[static_cast<std::size_t>(vital)]; }
    LimitSource limits() const; ///< the weakest source of the known limits of load, temperature and voltage
};

/// `fields` are those of the device's table. Where several registers say the same, the one nearest to its limit.
Vitals vitalsOf(const Device &device, const std::vector<VitalField> &fields);
/// The value's part of the way from `low` to `high`, or from zero where there is one limit; nothing without limits. A load's
/// sign doesn't count.
std::optional<double> partOf(Vital vital, const VitalReading &reading);

} // namespace dynascope
