// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/alarms.h"

namespace dynascope {

/// How bad a device's state is; the worst first.
enum class Severity {
    Fault,  ///< a hardware error, until a reboot
    Silent, ///< does not answer
    Over,   ///< something is beyond its limit
    Near,   ///< something is near its limit
    Good,
    Unknown, ///< parked, rebooting, without connection: nobody knows
};

enum class DashboardColumn { Device, Id, Position, Load, Temperature, Voltage, State };
constexpr int DashboardColumns = 7;
std::optional<Vital> vitalOf(DashboardColumn column); ///< nothing: the column has no bar

/// A value as it is shown.
struct DashboardCell {
    QString number; ///< empty: not known
    QString unit;
    std::optional<double> part; ///< of the way between its limits
    AlarmLevel level = AlarmLevel::None;
    QString help; ///< a sentence

    friend bool operator==(const DashboardCell &, const DashboardCell &) = default;
};

/// A device at a glance.
struct DashboardRow {
    DeviceKey key = 0;
    QString name;
    int id = 0;
    Severity severity = Severity::Unknown;
    QString state; ///< errors, else what it does, in a few words
    QString stateHelp;
    std::array<DashboardCell, VitalCount> cells; ///< by Vital
    LimitSource limits = LimitSource::None;

    friend bool operator==(const DashboardRow &, const DashboardRow &) = default;
};

DashboardRow dashboardRow(const Device &device, const Vitals &vitals, const Alarms &alarms,
                          const UnitPreferences &units);
QString severityText(Severity severity); ///< "near a limit"
QString dashboardHeading(DashboardColumn column);
QString dashboardHelp(DashboardColumn column);
QString widestNumber(Vital vital); ///< so that nothing moves while figures change

} // namespace dynascope
