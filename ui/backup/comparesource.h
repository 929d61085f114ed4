// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/backupcommands.h"
#include "ui/common/workbench.h"

#include <QComboBox>
#include <QPointer>

namespace dynascope {

/// One side of a comparison, chosen from a list: a device of the session, or a backup's file. GUI thread.
class CompareSource : public QComboBox
{
    Q_OBJECT

public:
    /// `commands`, and what `workbench` names, outlive this.
    CompareSource(const Workbench &workbench, BackupCommands &commands, QWidget *parent);

    void setDevice(Device &device);
    void setFile(const QString &path);

    bool isChosen() const { return m_device || m_file; }
    Device *device() const { return m_device; } ///< nullptr: a file, or nothing
    /// A device is read anew, a file was when it was chosen. Not called where nothing is chosen.
    void read(BackupCommands::Done done);

signals:
    void chosen();                  ///< another one, or none
    void failed(const QString &why); ///< that file can't be read, that device is gone: nothing is chosen now

private:
    void onActivated(int index);
    void onGone();
    void clear();

    Workbench m_workbench;
    BackupCommands &m_commands;
    QPointer<Device> m_device;
    std::optional<Backup> m_file;
    int m_shown = 0; ///< what stays chosen while a file is asked for
};

} // namespace dynascope
