// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows of the device tree say.
#include "ui/common/texts.h"
#include "ui/devices/devicetreemodel.h"

namespace dynascope {

QVariant DeviceTreeModel::lineData(const LineNode &node, int role) const
{
    switch (role) {
    case Qt::DisplayRole: return portText(node.line->name());
    case SubtitleRole: return lineStateText(*node.line);
    case Qt::ToolTipRole:
        return plainToolTip(QStringLiteral("%1\n%2").arg(node.line->name(), lineStateText(*node.line)));
    case Qt::AccessibleTextRole:
        return QStringLiteral("%1, %2").arg(portText(node.line->name()), lineStateText(*node.line));
    case DimmedRole: return node.line->state() != BusThread::State::Open;
    default: return {};
    }
}

QVariant DeviceTreeModel::baudData(const BaudNode &node, int role) const
{
    const bool working = node.line->line->baudRate() == node.baudRate;
    const auto count = node.devices.size();
    switch (role) {
    case Qt::DisplayRole: return baudText(node.baudRate);
    case SubtitleRole:
        if (working)
            return count == 1 ? tr("1 device") : tr("%1 devices").arg(count);
        return count == 1 ? tr("1 parked") : tr("%1 parked").arg(count);
    case Qt::ToolTipRole:
        return working ? tr("The line works at this baud rate")
                       : tr("The line works at %1: these devices are parked. \"Work at this baud\" moves the line.")
                             .arg(baudText(node.line->line->baudRate()));
    case DimmedRole: return !working || node.line->line->state() != BusThread::State::Open;
    case WorkingRole: return working;
    default: return {};
    }
}

QVariant DeviceTreeModel::deviceData(const Device &device, int role) const
{
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole: return device.nickname().isEmpty() ? device.model() : device.nickname();
    case SubtitleRole: {
        const QString state = deviceStateText(device);
        const QString alert = alertText(device);
        if (!alert.isEmpty())
            return QStringLiteral("%1 · %2").arg(alert, state);
        return device.nickname().isEmpty() ? state : QStringLiteral("%1 · %2").arg(device.model(), state);
    }
    case IdRole: return static_cast<int>(device.id());
    case AlertRole: return alertText(device);
    case DimmedRole:
        return device.state() != Device::State::Present
            || (device.line() && device.line()->state() != BusThread::State::Open);
    case TorqueRole: {
        const int enable = device.table().indexOf(Known::TorqueEnable);
        const auto torque = device.raw(Known::TorqueEnable);
        if (enable >= 0 && device.value(enable).unconfirmed)
            return {};
        return torque ? QVariant(*torque != 0) : QVariant();
    }
    case Qt::ToolTipRole: {
        QStringList lines{
            tr("%1, ID %2 at %3").arg(device.displayName()).arg(device.id()).arg(baudText(device.baudRate()))};
        lines << tr("%1, firmware %2").arg(device.model()).arg(device.firmware());
        if (device.isFirmwareNewerThanKnown()) {
            lines << tr("Newer than this program knows: the table of firmware %1 is shown")
                         .arg(device.table().description().newestFirmware);
        }
        if (const QString doubt = device.table().description().doubt; !doubt.isEmpty())
            lines << doubt;
        const QString help = deviceStateHelp(device);
        lines << (help.isEmpty() ? deviceStateText(device) : help);
        if (device.alert())
            lines << tr("Hardware error: %1").arg(alertText(device));
        if (!device.doubt().isEmpty())
            lines << device.doubt();
        return plainToolTip(lines.join(QLatin1Char('\n')));
    }
    case Qt::AccessibleTextRole:
        return tr("%1, ID %2, %3").arg(device.displayName()).arg(device.id()).arg(deviceStateText(device));
    default: return {};
    }
}

} // namespace dynascope
