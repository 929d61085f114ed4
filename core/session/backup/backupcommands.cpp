// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/backupcommands.h"

namespace dynascope {

BackupCommands::BackupCommands(Session &session, Commands &commands, QObject *parent)
    : QObject(parent), m_session(session), m_settings(session, commands)
{
}

void BackupCommands::read(Device &device, Done done)
{
    device.line()->bus().run<RegisterImage>(
        Priority::Normal, this,
        [plan = planBackupReading(placeOf(device), device.table())](JobContext &context) {
            return readForBackup(context, plan);
        },
        [this, key = device.key(), found = device.found(), model = device.model(), table = device.sharedTable(),
         done = std::move(done)](const Result<RegisterImage> &image) {
            if (!image)
                return done(tl::unexpected(image.error()));
            const Backup backup = backupOf(found, model, table, *image, QDateTime::currentDateTimeUtc());
            if (Device *present = m_session.device(key); present && present->sharedTable() == table) {
                for (const BackupRegister &one : backup.registers)
                    present->takeReadBack(one.field, one.raw);
            }
            done(backup);
        });
}

void BackupCommands::plan(Device &device, const Backup &backup, RestoreOptions options, Planned done)
{
    for (const auto &other : device.line()->devices()) {
        if (other.get() != &device && other->baudRate() == device.baudRate())
            options.settings.otherIds.insert(other->id());
    }
    read(device, [place = placeOf(device), backup, options, done = std::move(done)](const Result<Backup> &now) {
        if (!now)
            return done(tl::unexpected(now.error()));
        done(planRestore(backup, *now, place, options));
    });
}

void BackupCommands::restore(Device &device, const RestorePlan &plan, SettingsCommands::Done done)
{
    m_settings.apply(device, plan.wanted, plan.settings.options, std::move(done));
}

} // namespace dynascope
