// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/backupactions.h"

#include "core/session/session.h"
#include "ui/backup/comparedialog.h"
#include "ui/backup/inservodialog.h"
#include "ui/backup/restoredialog.h"
#include "ui/common/filedialogs.h"
#include "ui/common/icons.h"
#include "ui/common/present.h"

#include <QDir>
#include <QPointer>
#include <QWidget>

namespace dynascope {

/// Of several devices, one after the other.
struct BackupsUnderWay {
    QString folder;
    std::vector<DeviceKey> left; ///< the next one last
    int saved = 0;
    QStringList problems;
};

BackupActions::BackupActions(const Workbench &workbench, QWidget *window)
    : QObject(window)
    , m_workbench(workbench)
    , m_window(window)
    , m_commands(workbench.session, workbench.commands)
    , m_save(add("backup", "save", tr("Back up to file…"), tr("Save all registers of this device in a file"),
                 &BackupActions::save))
    , m_restore(add("restore", "folder", tr("Restore from file…"),
                    tr("Put registers back to what a backup holds, after a look at what would be written"),
                    &BackupActions::restoreFromFile))
    , m_compare(add("compare", "search", tr("Compare…"),
                    tr("Two devices or backups' files beside each other, register by register"),
                    &BackupActions::compare))
    , m_store(add("inServoBackup", "save", tr("Back up into the servo…"),
                  tr("Control Table Backup: the device keeps a backup of its own"), &BackupActions::storeInServo))
    , m_recall(add("inServoRestore", "refresh", tr("Restore from the servo's backup…"),
                   tr("Control Table Backup: the whole EEPROM goes back to the device's own backup"),
                   &BackupActions::recallFromServo))
{
    setDevice(nullptr);
}

QAction *BackupActions::add(const char *name, const char *iconName, const QString &text, const QString &tip,
                            void (BackupActions::*slot)())
{
    auto *action = new QAction(icon(QLatin1String(iconName)), text, this);
    action->setObjectName(QLatin1String(name) + QStringLiteral("Action"));
    action->setAutoRepeat(false);
    action->setToolTip(tip);
    action->setStatusTip(QString());
    connect(action, &QAction::triggered, this, slot);
    return action;
}

void BackupActions::setDevices(const std::vector<Device *> &devices)
{
    setDevice(devices.size() == 1 ? devices.front() : nullptr);
    if (devices.size() < 2)
        return;
    for (const Device *device : devices)
        m_several.push_back(device->key());
    m_save->setText(tr("Back up %1 devices to a folder…").arg(devices.size()));
    m_save->setEnabled(true);
}

void BackupActions::setDevice(Device *device)
{
    m_several.clear();
    m_save->setText(tr("Back up to file…"));
    m_device = device ? std::optional(device->key()) : std::nullopt;
    m_save->setEnabled(device);
    m_restore->setEnabled(device && device->isKnownModel());
    const bool hasOwn = device && device->table().hasBackup(device->firmware());
    const QString why =
        !device || hasOwn ? QString() : inServoProblem(device->table(), device->firmware(), false, {}, {});
    for (QAction *action : {m_store, m_recall}) {
        action->setEnabled(hasOwn);
        action->setStatusTip(why);
    }
}

Device *BackupActions::device() const
{
    return m_device ? m_workbench.session.device(*m_device) : nullptr;
}

void BackupActions::post(MessageKind kind, const QString &text)
{
    emit posted({kind, text, {}, {}});
}

/// Read first: where that fails nobody has chosen a name in vain.
void BackupActions::save()
{
    if (!m_several.empty())
        return askForFolder(m_window, tr("Back up %1 devices to").arg(m_several.size()),
                            [this, devices = m_several](const QString &folder) { saveAll(folder, devices); });
    Device *one = device();
    if (!one)
        return;
    m_commands.read(*one, [here = QPointer<BackupActions>(this),
                           name = one->displayName()](const Result<Backup> &backup) {
        if (!here)
            return;
        if (!backup)
            return here->post(MessageKind::Error, tr("%1 could not be backed up: %2").arg(name, backup.error().text));
        askWhereToSave(here->m_window, tr("Back up %1").arg(name), QStringLiteral("yaml"), suggestedFileName(*backup),
                       [here, backup = *backup](const QString &path) {
                           if (here)
                               here->saveTo(path, backup);
                       });
    });
}

/// A file for each, named by model, ID and time.
void BackupActions::saveAll(const QString &folder, const std::vector<DeviceKey> &devices)
{
    auto work = std::make_shared<BackupsUnderWay>();
    work->folder = folder;
    work->left.assign(devices.rbegin(), devices.rend());
    saveNext(work);
}

void BackupActions::saveNext(const std::shared_ptr<BackupsUnderWay> &work)
{
    Device *next = nullptr;
    while (!next && !work->left.empty()) {
        next = m_workbench.session.device(work->left.back()); // who is gone meanwhile is passed over
        work->left.pop_back();
    }
    if (next) {
        const QString name = next->displayName();
        return m_commands.read(*next, [here = QPointer<BackupActions>(this), work, name](const Result<Backup> &backup) {
            const Result<void> saved =
                backup ? saveBackup(QDir(work->folder).filePath(suggestedFileName(*backup)), *backup)
                       : tl::unexpected(backup.error());
            work->saved += saved ? 1 : 0;
            if (!saved)
                work->problems << tr("%1: %2").arg(name, saved.error().text);
            else if (!backup->unread.isEmpty())
                work->problems << tr("%1 did not show %2").arg(name, backup->unread.join(u", "));
            if (here)
                here->saveNext(work);
        });
    }
    QString text = tr("%1 devices are backed up in %2").arg(work->saved).arg(QDir::toNativeSeparators(work->folder));
    if (!work->problems.isEmpty())
        text += tr("; %1").arg(work->problems.join(tr("; ")));
    post(work->problems.isEmpty() ? MessageKind::Success : MessageKind::Warning, text);
}

void BackupActions::saveTo(const QString &path, const Backup &backup)
{
    const auto saved = saveBackup(path, backup);
    if (!saved)
        return post(MessageKind::Error, saved.error().text);
    const QString text = tr("%1 is backed up in %2").arg(backup.name(), QDir::toNativeSeparators(path));
    post(backup.unread.isEmpty() ? MessageKind::Success : MessageKind::Warning,
         backup.unread.isEmpty() ? text
                                 : tr("%1, without %2, which it did not show").arg(text, backup.unread.join(u", ")));
}

void BackupActions::restoreFromFile()
{
    Device *one = device();
    if (!one)
        return;
    askWhatToOpen(m_window, tr("Restore %1 from").arg(one->displayName()), {QStringLiteral("yaml")},
                   [this, key = one->key()](const QString &path) {
                       const auto backup = loadBackup(path, m_workbench.session.catalog());
                       Device *present = m_workbench.session.device(key);
                       if (!backup)
                           post(MessageKind::Error, backup.error().text.section(u'\n', 0, 0));
                       else if (present)
                           openRestore(*present, *backup, {});
                   });
}

void BackupActions::openRestore(Device &device, const Backup &backup, const QStringList &only)
{
    const QString subject = QStringLiteral("%1 %2 %3").arg(device.key()).arg(backup.file, only.join(u','));
    if (!raiseOpen(*m_window, QStringLiteral("restoreDialog"), subject))
        present(*new RestoreDialog(device, m_commands, backup, only, m_window), subject);
}

void BackupActions::compare()
{
    Device *one = device();
    const QString subject = one ? QString::number(one->key()) : QString();
    if (raiseOpen(*m_window, QStringLiteral("compareDialog"), subject))
        return;
    auto *dialog = new CompareDialog(one, m_workbench, m_commands, m_window);
    connect(dialog, &CompareDialog::restoreRequested, this,
            [this](DeviceKey key, const Backup &from, const QStringList &only) {
                if (Device *present = m_workbench.session.device(key))
                    openRestore(*present, from, only);
            });
    present(*dialog, subject);
}

void BackupActions::storeInServo()
{
    openInServo(BackupOption::Store);
}

void BackupActions::recallFromServo()
{
    openInServo(BackupOption::Restore);
}

void BackupActions::openInServo(BackupOption option)
{
    Device *one = device();
    if (!one)
        return;
    const QString name = option == BackupOption::Restore ? QStringLiteral("inServoRestoreDialog")
                                                         : QStringLiteral("inServoBackupDialog");
    const QString subject = QString::number(one->key());
    if (!raiseOpen(*m_window, name, subject))
        present(*new InServoDialog(*one, m_workbench.commands, option, m_window), subject);
}

} // namespace dynascope
