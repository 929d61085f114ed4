// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/dashboardrow.h"

#include "ui/common/texts.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

/// The context of what is translated here.
class DashboardTexts
{
    Q_DECLARE_TR_FUNCTIONS(DashboardTexts)
};

AlarmLevel levelOf(Vital vital, DeviceKey device, const Alarms &alarms)
{
    switch (vital) {
    case Vital::Load: return alarms.level(device, AlarmKind::Load);
    case Vital::Temperature: return alarms.level(device, AlarmKind::Temperature);
    case Vital::Voltage:
        return std::max(alarms.level(device, AlarmKind::OverVoltage), alarms.level(device, AlarmKind::UnderVoltage));
    case Vital::Error: return alarms.level(device, AlarmKind::Error);
    case Vital::Position: break;
    }
    return AlarmLevel::None;
}

QString limitText(const VitalLimit &limit, const Physical &as)
{
    const QString figure = withMinus(QString::number(limit.value, 'f', as.decimals));
    const QString value = as.unit.isEmpty() ? figure : figure + u' ' + as.unit;
    if (limit.name.isEmpty())
        return DashboardTexts::tr("within the range of Goal Position, to %1").arg(value);
    return limit.source == LimitSource::Device
               ? DashboardTexts::tr("its %1 is %2").arg(limit.name, value)
               : DashboardTexts::tr("the factory's %1 is %2, its own is not read yet").arg(limit.name, value);
}

QString helpOf(const Device &device, const VitalReading &reading)
{
    if (reading.field < 0)
        return DashboardTexts::tr("This model doesn't tell.");
    const QString name = device.table().fields()[static_cast<std::size_t>(reading.field)].name;
    if (!reading.raw)
        return DashboardTexts::tr("%1 is not known now.").arg(name);
    QStringList limits;
    for (const VitalLimit *limit : {&reading.low, &reading.high}) {
        if (limit->isKnown())
            limits << limitText(*limit, reading.value);
    }
    return limits.isEmpty() ? DashboardTexts::tr("%1; its limits are not known.").arg(name)
                            : QStringLiteral("%1; %2.").arg(name, limits.join(QStringLiteral("; ")));
}

DashboardCell cellOf(const Device &device, Vital vital, const VitalReading &reading, const UnitPreferences &units)
{
    DashboardCell cell;
    cell.help = helpOf(device, reading);
    if (reading.field < 0 || !reading.raw)
        return cell;
    const Physical value = physical(device.effective(reading.field), device.table().resolution(), *reading.raw, units);
    cell.number = withMinus(QString::number(value.value, 'f', value.decimals));
    cell.unit = value.unit;
    cell.part = partOf(vital, reading);
    return cell;
}

Severity severityOf(const DashboardRow &row, const Vitals &vitals, const Alarms &alarms)
{
    if (alarms.level(row.key, AlarmKind::Error) != AlarmLevel::None)
        return Severity::Fault;
    if (alarms.level(row.key, AlarmKind::Silent) != AlarmLevel::None)
        return Severity::Silent;
    const AlarmLevel level = alarms.level(row.key);
    if (level != AlarmLevel::None)
        return level == AlarmLevel::Over ? Severity::Over : Severity::Near;
    return vitals.isThere ? Severity::Good : Severity::Unknown;
}

} // namespace

std::optional<Vital> vitalOf(DashboardColumn column)
{
    switch (column) {
    case DashboardColumn::Position: return Vital::Position;
    case DashboardColumn::Load: return Vital::Load;
    case DashboardColumn::Temperature: return Vital::Temperature;
    case DashboardColumn::Voltage: return Vital::Voltage;
    default: return std::nullopt;
    }
}

DashboardRow dashboardRow(const Device &device, const Vitals &vitals, const Alarms &alarms,
                          const UnitPreferences &units)
{
    DashboardRow row;
    row.key = device.key();
    row.name =
        device.nickname().isEmpty() ? device.model() : QStringLiteral("%1 · %2").arg(device.nickname(), device.model());
    row.id = device.id();
    row.severity = severityOf(row, vitals, alarms);
    row.state = vitals.errors.isEmpty() ? deviceStateText(device) : vitals.errors;
    row.stateHelp = vitals.errors.isEmpty()
                        ? deviceStateHelp(device)
                        : DashboardTexts::tr("Hardware error: %1. It stays until a reboot.").arg(vitals.errors);
    row.limits = vitals.limits();
    for (int i = 0; i < VitalCount; ++i) {
        const auto vital = static_cast<Vital>(i);
        DashboardCell &cell = row.cells[static_cast<std::size_t>(i)];
        cell = cellOf(device, vital, vitals[vital], units);
        cell.level = levelOf(vital, row.key, alarms);
    }
    return row;
}

QString severityText(Severity severity)
{
    switch (severity) {
    case Severity::Fault: return DashboardTexts::tr("hardware error");
    case Severity::Silent: return DashboardTexts::tr("silent");
    case Severity::Over: return DashboardTexts::tr("beyond a limit");
    case Severity::Near: return DashboardTexts::tr("near a limit");
    case Severity::Good: return DashboardTexts::tr("good");
    case Severity::Unknown: break;
    }
    return DashboardTexts::tr("not known");
}

QString dashboardHeading(DashboardColumn column)
{
    switch (column) {
    case DashboardColumn::Device: return DashboardTexts::tr("Device");
    case DashboardColumn::Id: return DashboardTexts::tr("ID");
    case DashboardColumn::Position: return DashboardTexts::tr("Position");
    case DashboardColumn::Load: return DashboardTexts::tr("Load");
    case DashboardColumn::Temperature: return DashboardTexts::tr("Temperature");
    case DashboardColumn::Voltage: return DashboardTexts::tr("Voltage");
    case DashboardColumn::State: return DashboardTexts::tr("State");
    }
    return {};
}

QString dashboardHelp(DashboardColumn column)
{
    switch (column) {
    case DashboardColumn::Device:
    case DashboardColumn::Id:
        return DashboardTexts::tr("All devices, the worst first: those with a hardware error, then "
                                  "silent, beyond a limit, near one.");
    case DashboardColumn::Position:
        return DashboardTexts::tr("The mark: where it stands in the range of Goal Position.");
    case DashboardColumn::Load:
        return DashboardTexts::tr("Present Current of its Current Limit, else Present Load of its PWM Limit. Near from "
                                  "80 % on, beyond from 95 % on.");
    case DashboardColumn::Temperature:
        return DashboardTexts::tr("Of its Temperature Limit, at which it turns itself off. Near from 10 °C below on.");
    case DashboardColumn::Voltage:
        return DashboardTexts::tr("The mark: where it is between its Min and Max Voltage Limit. Near from 3 % on.");
    case DashboardColumn::State: return DashboardTexts::tr("Hardware errors, else what the device does.");
    }
    return {};
}

QString widestNumber(Vital vital)
{
    switch (vital) {
    case Vital::Position: return QStringLiteral("−000.00");
    case Vital::Load: return QStringLiteral("−0000.0");
    case Vital::Temperature: return QStringLiteral("000");
    case Vital::Voltage: return QStringLiteral("00.0");
    case Vital::Error: break;
    }
    return {};
}

} // namespace dynascope
