// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/protocol_values.h"
#include "ui/devices/devicedialog.h"

namespace dynascope {

class Commands;

/// The device's own backup (Control Table Backup): made or restored, with its conditions.
class InServoDialog : public DeviceDialog
{
    Q_OBJECT

public:
    InServoDialog(Device &device, Commands &commands, BackupOption option, QWidget *parent);

    void accept() override;

protected:
    void check() override;

private:
    Commands &m_commands;
    const BackupOption m_option;
};

} // namespace dynascope
