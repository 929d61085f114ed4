// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/protocol_values.h"
#include "ui/devices/devicedialog.h"

class QButtonGroup;
class QLabel;

namespace dynascope {

class Commands;

/// The three options of Factory Reset, each with what survives it.
class FactoryResetDialog : public DeviceDialog
{
    Q_OBJECT

public:
    FactoryResetDialog(Device &device, Commands &commands, QWidget *parent);

    void accept() override;

protected:
    void check() override;

private:
    void addOption(ResetOption option, const QString &name, const QString &title);
    void showPlaces(); ///< where each option would leave the device
    ResetOption option() const;

    Commands &m_commands;
    QButtonGroup *m_options;
    std::vector<QLabel *> m_places; ///< in the order of the options
};

} // namespace dynascope
