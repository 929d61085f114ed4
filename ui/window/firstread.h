// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <set>

namespace dynascope {

/// Reads the whole table of a device when it is first shown, and again when it comes back after having been away: what
/// isn't polled would stay unknown or stale.
class FirstRead : public QObject
{
    Q_OBJECT

public:
    explicit FirstRead(const Workbench &workbench, QObject *parent = nullptr);

    void show(const std::vector<Device *> &devices); ///< what the table shows now

private:
    void follow(LineSession *line);
    void onDevice(Device *device);
    void onLine(LineSession *line);
    void read(Device &device);

    Workbench m_workbench;
    std::set<DeviceKey> m_shown;
    std::set<DeviceKey> m_asked; ///< since they were last away
};

} // namespace dynascope
