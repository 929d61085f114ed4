// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/devices/devicedialog.h"

class QComboBox;
class QLabel;

namespace dynascope {

class Commands;

/// Another baud rate for one device, of those its model offers. Says beforehand whether it will be parked.
class ChangeBaudDialog : public DeviceDialog
{
    Q_OBJECT

public:
    ChangeBaudDialog(Device &device, Commands &commands, QWidget *parent);

    void accept() override;

protected:
    void check() override;

private:
    bool isAlone() const; ///< nobody else at the line's working baud rate
    int mostLikely(const Device &device) const;
    void fill(); ///< with every rate but its own

    Commands &m_commands;
    QComboBox *m_baud;
    QLabel *m_present;
    int m_filledFor = 0; ///< its rate when the list was made
};

} // namespace dynascope
