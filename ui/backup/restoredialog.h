// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/backupcommands.h"
#include "ui/devices/devicedialog.h"

class QCheckBox;
class QPlainTextEdit;

namespace dynascope {

/// The dry run of a restore: what would be written, what is left and what could not be carried; then the real one.
class RestoreDialog : public DeviceDialog
{
    Q_OBJECT

public:
    /// `only`: these registers; empty: all. `commands` outlives this.
    RestoreDialog(Device &device, BackupCommands &commands, Backup backup, const QStringList &only, QWidget *parent);

    void accept() override;

protected:
    void check() override;

private:
    void look();
    void show(const Result<RestorePlan> &plan);
    RestoreOptions options() const;

    BackupCommands &m_commands;
    const Backup m_backup;
    const QStringList m_only;
    QCheckBox *m_calibration;
    QPlainTextEdit *m_list;
    Result<RestorePlan> m_plan;
    bool m_isRead = false; ///< the plan is one, or says why there is none
    int m_looks = 0; ///< the newest counts
};

} // namespace dynascope
