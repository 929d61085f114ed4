// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/backupcommands.h"
#include "ui/common/workbench.h"

#include <QDialog>
#include <QPointer>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QTreeView;

namespace dynascope {

class CompareModel;

/// A device beside a backup's file or another device. Closes when its device goes. For present(), never exec().
class CompareDialog : public QDialog
{
    Q_OBJECT

public:
    /// `commands` outlives this.
    CompareDialog(Device &device, const Workbench &workbench, BackupCommands &commands, QWidget *window);

    void compareWithFile(const QString &path);
    void compareWithDevice(DeviceKey key);

signals:
    /// These registers of the other side, whose file or device it is, to be restored to the device.
    void restoreRequested(dynascope::DeviceKey device, const dynascope::Backup &from, const QStringList &only);

private:
    void makeView();
    void fillSources();
    void chosen(int index);
    void askForFile();
    void readHere();
    void setThere(const Result<Backup> &there);
    void update();
    void say(const QString &text);
    void restoreSelected();
    QStringList selectedNames() const;

    Workbench m_workbench;
    BackupCommands &m_commands;
    QPointer<Device> m_device;
    CompareModel *m_model;
    QTreeView *m_view;
    QComboBox *m_with;
    QCheckBox *m_onlyDifferences;
    QLabel *m_summary;
    QPushButton *m_restore;
    std::optional<Backup> m_here, m_there;
    int m_reads = 0; ///< the newest counts
};

} // namespace dynascope
