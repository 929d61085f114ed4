// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/restoredialog.h"

#include "ui/common/texts.h"

#include <QCheckBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPlainTextEdit>

namespace dynascope {
namespace {

using RowState = RestoreRow::State;

QString linesOf(const RestorePlan &plan, RowState state, const QString &heading)
{
    QStringList lines;
    for (const RestoreRow &row : plan.rows) {
        if (row.state != state)
            continue;
        lines << (state == RowState::Differs
                      ? QStringLiteral("    %1: %2 → %3").arg(row.name, row.nowText, row.wantedText)
                      : QStringLiteral("    %1: %2").arg(row.name, row.why));
    }
    return lines.isEmpty() ? QString() : heading + u'\n' + lines.join(u'\n') + u'\n';
}

} // namespace

RestoreDialog::RestoreDialog(Device &device, BackupCommands &commands, Backup backup, const QStringList &only,
                             QWidget *parent)
    : DeviceDialog(device, tr("Restore"), tr("Write"), parent)
    , m_commands(commands)
    , m_backup(std::move(backup))
    , m_only(only)
    , m_calibration(new QCheckBox(tr("Also what belongs to the single device (Homing Offset)"), this))
    , m_list(new QPlainTextEdit(this))
    , m_plan(failure(ErrorKind::NotFound, tr("The device is being read…")))
{
    setObjectName(QStringLiteral("restoreDialog"));
    auto *from = new QLabel(
        tr("From %1: %2, firmware %3, %4")
            .arg(m_backup.file.isEmpty() ? tr("a device") : QFileInfo(m_backup.file).fileName(), m_backup.name())
            .arg(m_backup.firmware)
            .arg(m_backup.at.toLocalTime().toString(QStringLiteral("yyyy-MM-dd hh:mm"))),
        this);
    from->setTextFormat(Qt::PlainText);
    from->setWordWrap(true);
    m_calibration->setObjectName(QStringLiteral("restoreCalibration"));
    m_calibration->setChecked(m_backup.id == device.id() && m_backup.firmware == device.firmware());
    m_list->setObjectName(QStringLiteral("restoreList"));
    m_list->setAccessibleName(tr("What would be written"));
    m_list->setReadOnly(true);
    m_list->setTabChangesFocus(true);
    m_list->setMinimumHeight(220);
    setMinimumWidth(640);
    form()->addRow(from);
    form()->addRow(m_list);
    form()->addRow(m_calibration);
    beginWith(m_list);
    connect(m_calibration, &QCheckBox::toggled, this, &RestoreDialog::look);
    RestoreDialog::check();
    look();
}

RestoreOptions RestoreDialog::options() const
{
    RestoreOptions options;
    options.calibration = m_calibration->isChecked();
    options.only = m_only;
    options.settings.mayTurnTorqueOff = turnsTorqueOff();
    return options;
}

void RestoreDialog::look()
{
    if (!device())
        return;
    const int number = ++m_looks;
    m_commands.plan(*device(), m_backup, options(),
                    [here = QPointer<RestoreDialog>(this), number](const Result<RestorePlan> &plan) {
                        if (here && number == here->m_looks)
                            here->show(plan);
                    });
}

void RestoreDialog::show(const Result<RestorePlan> &plan)
{
    m_plan = plan;
    m_isRead = true;
    QString text;
    if (plan) {
        text = linesOf(*plan, RowState::Differs, tr("Would be written:"))
               + linesOf(*plan, RowState::NotCarried, tr("Could not be carried:"))
               + linesOf(*plan, RowState::Left, tr("Left as it is:"));
        text += tr("%1 registers are the same already.").arg(plan->count(RowState::Same));
    }
    m_list->setPlainText(withBaudTexts(text));
    check();
}

void RestoreDialog::check()
{
    if (!device())
        return;
    if (!m_plan)
        return m_isRead ? setNote(MessageKind::Error, asSentence(m_plan.error().text))
                        : setNote(MessageKind::Info, m_plan.error().text, false);
    if (m_plan->writesNothing())
        return setNote(MessageKind::Info, tr("Nothing has to be written."), false);
    if (!torqueAllows())
        return setNote(MessageKind::Error, tr("Torque is on, which locks the EEPROM."));
    QString text = tr("%1 registers will be written and read back.").arg(m_plan->count(RowState::Differs));
    if (device()->isTorqueOn())
        text += u' ' + tr("Torque goes off first and stays off: what it holds may fall.");
    setNote(device()->isTorqueOn() ? MessageKind::Warning : MessageKind::Info, text);
}

void RestoreDialog::accept()
{
    if (device() && m_plan) {
        RestorePlan plan = *m_plan;
        plan.settings.options.mayTurnTorqueOff = turnsTorqueOff();
        m_commands.restore(*device(), plan);
    }
    DeviceDialog::accept();
}

} // namespace dynascope
