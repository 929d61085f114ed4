// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/devices/devicedialog.h"

class QLabel;
class QSpinBox;

namespace dynascope {

class Commands;

/// Another ID for one device. IDs that others at its baud rate answer to are refused before anything is written.
class ChangeIdDialog : public DeviceDialog
{
    Q_OBJECT

public:
    ChangeIdDialog(Device &device, Commands &commands, QWidget *parent);

    void accept() override;

protected:
    void check() override;

private:
    int firstFree() const;
    void showPlace();

    Commands &m_commands;
    QSpinBox *m_id;
    QLabel *m_present;
    QLabel *m_takenAt;
    QLabel *m_taken;
};

} // namespace dynascope
