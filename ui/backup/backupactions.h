// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/backupcommands.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"

#include <QAction>

namespace dynascope {

struct BackupsUnderWay;

/// Backups of the one device that is selected, as actions for menu and context menu.
class BackupActions : public QObject
{
    Q_OBJECT

public:
    BackupActions(const Workbench &workbench, QWidget *window);

    void setDevice(Device *device); ///< nullptr: not just one, or it can't be reached
    void setDevices(const std::vector<Device *> &devices); ///< that can be reached; several can be backed up, too
    std::vector<QAction *> actions() const { return {m_save, m_restore, m_compare, m_store, m_recall}; }

signals:
    void posted(const dynascope::Message &message);

private:
    QAction *add(const char *name, const char *iconName, const QString &text, const QString &tip,
                 void (BackupActions::*slot)());
    Device *device() const;
    void post(MessageKind kind, const QString &text);
    void save();
    void saveAll(const QString &folder, const std::vector<DeviceKey> &devices);
    void saveNext(const std::shared_ptr<BackupsUnderWay> &work);
    void saveTo(const QString &path, const Backup &backup);
    void restoreFromFile();
    void compare();
    void storeInServo();
    void recallFromServo();
    void openRestore(Device &device, const Backup &backup, const QStringList &only);
    void openInServo(BackupOption option);

    Workbench m_workbench;
    QWidget *m_window;
    BackupCommands m_commands;
    std::optional<DeviceKey> m_device;
    std::vector<DeviceKey> m_several; ///< none where it is one
    QAction *m_save, *m_restore, *m_compare, *m_store, *m_recall;
};

} // namespace dynascope
