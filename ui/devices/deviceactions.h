// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/backup/backupactions.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

#include <QAction>

#include <set>

namespace dynascope {

/// What can be done with the selected devices, as actions for menu, context menu and tool row. Asks only where
/// something can't be taken back or something falls.
class DeviceActions : public QObject
{
    Q_OBJECT

public:
    DeviceActions(const Workbench &workbench, QWidget *window);

    /// `baudRate` of `line` is what "Work at this baud" moves to; 0 where nothing suitable is selected.
    void setSelection(const std::vector<Device *> &devices, LineSession *line, int baudRate);
    void update(); ///< a device's state changed
    void openChangeId(Device *device);
    void openChangeBaud(Device *device);

    /// In the order of a menu; nullptr stands for a separator.
    std::vector<QAction *> menuActions() const;
    /// The few for the row above the tree.
    std::vector<QAction *> rowActions() const { return {m_identify, m_torqueOn, m_torqueOff, m_readAll, m_reboot}; }

signals:
    void posted(const dynascope::Message &message);
    void moveRequested(dynascope::LineSession *line, const std::vector<dynascope::Device *> &devices);
    /// A person turned torque on here, and it is on now.
    void torqueEnabled(const std::vector<dynascope::DeviceKey> &devices);

private:
    QAction *add(const QString &name, const QString &iconName, const QString &text, const QString &shortcut,
                 const QString &tip, void (DeviceActions::*slot)());
    std::vector<Device *> devices() const; ///< those that still live
    std::vector<Device *> living(const std::vector<DeviceKey> &keys) const;
    std::vector<Device *> reachable() const;
    Device *single() const;
    static QString subjectOf(const std::vector<Device *> &devices); ///< for present()
    static QString namesOf(const std::vector<Device *> &devices);
    template <typename Dialog>
    void open(Device &device, const QString &name); ///< the one about it that is open comes to the front
    bool tellOfTorqueOn(Device &device);
    void turnTorqueOn(const std::vector<Device *> &devices);
    /// Asks about `devices`; `action` gets those of them that are still there. The question goes with any of them.
    void confirm(const QString &title, const QString &text, const std::vector<Device *> &devices,
                 std::function<void(const std::vector<Device *> &)> action);

    void identify();
    void torqueOn();
    void torqueOff();
    void readAll();
    void reboot();
    void rename();
    void changeId();
    void changeBaud();
    void moveMany();
    void workAtBaud();
    void clearMultiTurn();
    void saveHybrid();
    void factoryReset();
    void forget();

    Workbench m_workbench;
    QWidget *m_window;
    BackupActions *m_backups;
    std::vector<DeviceKey> m_selected;
    std::set<DeviceKey> m_reading; ///< all of it is being read: one job each, however often it is asked for
    QPointer<LineSession> m_line;
    int m_baudRate = 0;
    QAction *m_identify, *m_torqueOn, *m_torqueOff, *m_readAll, *m_reboot, *m_rename, *m_changeId, *m_changeBaud,
        *m_moveMany, *m_workAtBaud, *m_clearMultiTurn, *m_saveHybrid, *m_factoryReset, *m_forget;
};

} // namespace dynascope
