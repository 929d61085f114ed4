// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a device restart, or forget where it was.
#include "core/session/commands.h"
#include "ui/common/present.h"
#include "ui/devices/deviceactions.h"
#include "ui/devices/factoryresetdialog.h"
#include "ui/devices/resetmanydialog.h"

#include <algorithm>

namespace dynascope {

/// Of one without torque the tool tip says it: nothing is lost that wasn't in RAM.
void DeviceActions::reboot()
{
    const std::vector<Device *> devices = reachable();
    const auto run = [this](const std::vector<Device *> &present) {
        for (Device *device : present)
            m_workbench.commands.reboot(*device);
    };
    const auto held = std::ranges::count_if(devices, &Device::isTorqueOn);
    if (devices.size() == 1 && held == 0)
        return run(devices);
    if (devices.size() == 1) {
        return confirm(tr("Reboot"),
                       tr("%1 is under torque. It lets go when it reboots; what it holds may fall.")
                           .arg(devices.front()->displayName()),
                       devices, run);
    }
    QString text = tr("Reboot %1 devices? Torque goes off, what is only in RAM (goals, profiles, most gains) goes back "
                      "to defaults, and a position of several turns into one turn. EEPROM, ID and baud rate stay; a "
                      "latched hardware error is cleared.")
                       .arg(devices.size());
    if (held > 0)
        text += u' ' + tr("%1 of these devices are under torque. They let go; what they hold may fall.").arg(held);
    confirm(tr("Reboot"), text + QStringLiteral("\n\n") + namesOf(devices), devices, run);
}

void DeviceActions::clearMultiTurn()
{
    for (Device *device : reachable())
        m_workbench.commands.clearMultiTurn(*device);
}

void DeviceActions::factoryReset()
{
    const std::vector<Device *> devices = reachable();
    const QString subject = subjectOf(devices);
    const QString name = devices.size() == 1 ? QStringLiteral("factoryResetDialog") : QStringLiteral("resetManyDialog");
    if (devices.empty() || raiseOpen(*m_window, name, subject))
        return;
    if (devices.size() == 1)
        present(*new FactoryResetDialog(*devices.front(), m_workbench.commands, m_window), subject);
    else
        present(*new ResetManyDialog(devices, m_workbench.session, m_workbench.commands, m_window), subject);
}

} // namespace dynascope
