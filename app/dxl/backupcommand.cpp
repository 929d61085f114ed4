// SPDX-License-Identifier: GPL-3.0-or-later
// All registers of devices into files, or into the devices themselves by Control Table Backup.
#include "app/dxl/backupcommand.h"

#include "app/dxl/directjob.h"
#include "app/dxl/noting.h"
#include "app/dxl/restarting.h"
#include "app/dxl/target.h"
#include "core/session/backup/restore.h"

#include <QDir>
#include <QFileInfo>

namespace dynascope::dxl {

namespace {

QString pathFor(const BackupOptions &options, const Backup &backup)
{
    if (!options.file.isEmpty())
        return options.file;
    return options.folder.isEmpty() ? suggestedFileName(backup)
                                    : QDir(options.folder).filePath(suggestedFileName(backup));
}

Result<void> saveOne(const Work &work, Device &device)
{
    const BackupOptions &options = work.options.backup;
    const auto backup = backupDevice(work, device);
    if (!backup)
        return tl::unexpected(backup.error());
    const QString path = pathFor(options, *backup);
    if (QFileInfo::exists(path) && !options.replace) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("%1 is there already; --replace writes it anew").arg(path));
    }
    if (!options.folder.isEmpty() && !QDir().mkpath(options.folder))
        return failure(ErrorKind::BadFile, QStringLiteral("the folder %1 can't be made").arg(options.folder));
    if (const auto saved = saveBackup(path, *backup); !saved)
        return saved;
    if (!backup->unread.isEmpty()) {
        work.output.note(QStringLiteral("%1 does not show %2; the backup is without")
                             .arg(device.name(), backup->unread.join(QStringLiteral(", "))));
    }
    const auto count = backup->isKnownModel() ? static_cast<qint64>(backup->registers.size()) : 0;
    Document document;
    document.add("id", qint64(device.id()))
        .add("model", backup->model)
        .add("firmware", qint64(backup->firmware))
        .add("file", path)
        .add("registers", count)
        .add("unread", backup->unread);
    work.output.result(QStringLiteral("%1: %2 registers in %3").arg(device.name()).arg(count).arg(path), document);
    return {};
}

/// Nothing where the device has no such register, or doesn't show it.
Result<std::optional<std::int64_t>> registerOf(Device &device, QStringView name)
{
    const Field *field = device.table() && !device.isMute() ? device.table()->find(name) : nullptr;
    if (!field)
        return std::nullopt;
    const auto raw = device.read(*field);
    if (!raw && raw.error().kind != ErrorKind::Refused)
        return tl::unexpected(raw.error());
    return raw ? std::optional(*raw) : std::nullopt;
}

Result<void> checkInServo(Device &device, bool restore)
{
    if (!device.table())
        return {};
    const auto torque = registerOf(device, u"Torque Enable");
    if (!torque)
        return tl::unexpected(torque.error());
    const auto ready = registerOf(device, u"Backup Ready");
    if (!ready)
        return tl::unexpected(ready.error());
    const QString problem = inServoProblem(*device.table(), device.found().firmware, restore, *torque, *ready);
    if (problem.isEmpty())
        return {};
    return failure(ErrorKind::NotSupported, QStringLiteral("%1: %2; nothing was sent").arg(device.name(), problem));
}

Result<void> inServoOne(const Work &work, Device &device, bool restore)
{
    if (const auto can = checkInServo(device, restore); !can)
        return can;
    JournalNote note = noteEvent(work, device, restore ? JournalKind::Restore : JournalKind::Backup);
    const auto done = backup(work.bus, device.id(), restore ? BackupOption::Restore : BackupOption::Store);
    finish(note, done);
    if (!done && (!restore || !mayHaveArrived(done.error())))
        return done;
    if (restore) {
        const DevicePlace place = placeOf(device);
        LineTime took{};
        if (const auto found = awaitReturn(work.bus, place, place, took); !found) {
            return failure(found.error().kind,
                           found.error().text + QStringLiteral(": the backup may hold another ID or baud rate"));
        }
    }
    const QString what = restore ? QStringLiteral("restored") : QStringLiteral("stored");
    Document document;
    document.add("id", qint64(device.id())).add("backup", what);
    work.output.result(QStringLiteral("%1: control table %2").arg(device.name(), what), document);
    return {};
}

} // namespace

Result<Backup> backupDevice(const Work &work, Device &device)
{
    const Found &found = device.found();
    const ControlTablePtr table = work.catalog.findOrRaw(found.modelNumber, found.firmware);
    DirectJob job(work.bus);
    const auto image = readForBackup(job, planBackupReading(placeOf(device), *table));
    if (!image)
        return tl::unexpected(image.error());
    return backupOf(found, modelName(work.catalog, found.modelNumber), table, *image, QDateTime::currentDateTimeUtc());
}

ExitCode inServoCommand(const Work &work, bool restore)
{
    const QString what =
        QStringLiteral("restoring the backup that %1 %2 overwrites the EEPROM, ID and baud rate with it")
            .arg(idsText(work.options),
                 work.options.idList.size() == 1 ? QStringLiteral("holds") : QStringLiteral("hold"));
    if (restore && !mayGoOn(work, what))
        return ExitCode::Usage;
    return forEachDevice(work, [&](Device &device) { return inServoOne(work, device, restore); });
}

ExitCode backupCommand(const Work &work)
{
    const BackupOptions &options = work.options.backup;
    if (options.inServo)
        return inServoCommand(work, options.restores);
    if (!options.file.isEmpty() && QFileInfo::exists(options.file) && !options.replace) {
        return work.output.refuse({ErrorKind::InvalidArgument,
                                   QStringLiteral("%1 is there already; --replace writes it anew").arg(options.file)});
    }
    return forEachDevice(work, [&](Device &device) { return saveOne(work, device); });
}

} // namespace dynascope::dxl
