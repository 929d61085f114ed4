// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <map>

class QWidget;

namespace dynascope {

/// Knows which devices stand under torque because somebody turned it on in this window, and asks once before the window
/// closes on them.
class TorqueGuard : public QObject
{
    Q_OBJECT

public:
    TorqueGuard(const Workbench &workbench, QWidget *window);

    void noteEnabled(const std::vector<DeviceKey> &devices);
    std::vector<Device *> holding() const; ///< those of them that still are under torque, or may be
    /// True: the window may close. False: it has asked; closeAgreed() follows, or nothing.
    bool mayClose();

signals:
    void closeAgreed();

private:
    void follow(Device *device);
    void onFields(Device *device, int first, int last);

    Workbench m_workbench;
    QWidget *m_window;
    std::map<DeviceKey, bool> m_enabled; ///< true: has been seen on since
    bool m_agreed = false;
};

} // namespace dynascope
