// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tableactions.h"

#include "core/session/commands.h"
#include "ui/common/workbench.h"
#include "ui/table/tablepanel.h"

namespace dynascope {

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
    actions.setUnfolded = [&monitor](const std::set<Watch> &fields) { monitor.setUnfolded(fields); };
    return actions;
}

TablePanel::TablePanel(const Workbench &workbench, QWidget *parent)
    : TablePanel(tableActions(workbench), {}, parent)
{
    connect(&workbench.monitor, &Monitor::watchesChanged, this, &TablePanel::refreshWatches);
}

} // namespace dynascope
