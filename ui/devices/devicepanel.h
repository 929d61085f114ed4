// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <QWidget>

namespace dynascope {

/// Line → baud → device, live as a scan finds them, with the devices' actions.
class DevicePanel : public QWidget
{
    Q_OBJECT

public:
    explicit DevicePanel(const Workbench &workbench, QWidget *parent = nullptr);

    std::vector<Device *> selectedDevices() const;
    void selectDevice(Device *device);

signals:
    void selectionChanged();
    void message(const QString &text);
};

} // namespace dynascope
