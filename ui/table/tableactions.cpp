// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tableactions.h"

#include "core/session/settingscommands.h"
#include "ui/common/workbench.h"
#include "ui/table/tablepanel.h"

namespace dynascope {

std::function<void(Device &, int, std::int64_t, bool)> safeWrites(const Workbench &workbench)
{
    SettingsCommands *settings = workbench.settings;
    if (!settings)
        return {};
    return [settings](Device &device, int field, std::int64_t raw, bool torqueBack) {
        SettingsOptions options;
        if (field == device.table().indexOf(Known::TorqueEnable)) {
            options.turnTorqueOn = true;
            return settings->apply(device, {}, options);
        }
        options.mayTurnTorqueOff = options.keepResets = true;
        options.putTorqueBack = torqueBack;
        settings->apply(device, {{field, raw}}, options);
    };
}

TableActions tableActions(const Workbench &workbench)
{
    Commands &commands = workbench.commands;
    Monitor &monitor = workbench.monitor;
    TableActions actions;
    actions.write
        = [&commands](Device &device, int field, std::int64_t raw) { commands.writeField(device, field, raw); };
    actions.torqueOff = [&commands](const std::vector<Device *> &devices, std::function<void(Result<void>)> done) {
        commands.setTorque(devices, false, std::move(done));
    };
    actions.readAll = [&commands](Device &device) { commands.readAll(device); };
    actions.isWatched = [&monitor](const Watch &watch) { return monitor.isWatched(watch); };
    actions.writeUnknown
        = [&commands](Device &device, int field, std::int64_t raw) { commands.writeUnknown(device, field, raw); };
    actions.writeSafely = safeWrites(workbench);
    actions.setUnfolded = [&monitor](const std::set<Watch> &fields) { monitor.setUnfolded(fields); };
    if (RamGuard *guard = workbench.ramGuard) {
        actions.ramState = [guard](const Watch &watch) { return guard->stateOf(watch.device, watch.field); };
        actions.setAgain = [guard](const std::vector<Device *> &devices, RamGuard::Done done) {
            std::vector<DeviceKey> keys;
            for (const Device *device : devices)
                keys.push_back(device->key());
            guard->setAgain(keys, std::move(done));
        };
    }
    return actions;
}

TablePanel::TablePanel(const Workbench &workbench, QWidget *parent)
    : TablePanel(tableActions(workbench), {}, parent)
{
    connect(&workbench.monitor, &Monitor::watchesChanged, this, &TablePanel::refreshWatches);
    if (workbench.ramGuard)
        connect(workbench.ramGuard, &RamGuard::changed, this, &TablePanel::refreshMarks);
}

} // namespace dynascope
