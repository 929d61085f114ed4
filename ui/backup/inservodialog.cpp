// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/inservodialog.h"

#include "core/session/backup/restore.h"
#include "core/session/commands.h"

#include <QFormLayout>
#include <QLabel>

namespace dynascope {

InServoDialog::InServoDialog(Device &device, Commands &commands, BackupOption option, QWidget *parent)
    : DeviceDialog(
        device, option == BackupOption::Restore ? tr("Restore from the servo's backup") : tr("Back up into the servo"),
        option == BackupOption::Restore ? tr("Restore") : tr("Back up"), parent)
    , m_commands(commands)
    , m_option(option)
{
    setObjectName(option == BackupOption::Restore ? QStringLiteral("inServoRestoreDialog")
                                                  : QStringLiteral("inServoBackupDialog"));
    leaveTorque(); // turning it off is a decision of its own
    auto *conditions = new QLabel(inServoConditions(), this);
    conditions->setWordWrap(true);
    conditions->setTextFormat(Qt::PlainText);
    conditions->setMinimumHeight(conditions->heightForWidth(400));
    form()->addRow(conditions);
    InServoDialog::check();
}

void InServoDialog::check()
{
    if (!device())
        return;
    const bool restore = m_option == BackupOption::Restore;
    const QString problem = inServoProblem(device()->table(), device()->firmware(), restore,
                                           device()->raw(Known::TorqueEnable), device()->raw(u"Backup Ready"));
    if (!problem.isEmpty())
        return setNote(MessageKind::Error, tr("%1: %2.").arg(device()->displayName(), problem));
    if (restore)
        return setNote(MessageKind::Warning,
                       tr("The whole EEPROM is overwritten, and the device restarts. With another ID or "
                          "baud rate in its backup a scan finds it."));
    const bool isThere = device()->raw(u"Backup Ready").value_or(0) != 0;
    setNote(isThere ? MessageKind::Warning : MessageKind::Info,
            isThere ? tr("The backup that it holds already is replaced.") : tr("It holds no backup yet."));
}

void InServoDialog::accept()
{
    if (device())
        m_commands.controlTableBackup(*device(), m_option);
    DeviceDialog::accept();
}

} // namespace dynascope
