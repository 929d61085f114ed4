// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/backup/restore.h"
#include "tests/support/settingsworld.h"

namespace dynascope::test {

/// Servos on a simulated bus that are backed up, and restored from what that gave.
struct BackupWorld : SettingsWorld {
    BackupWorld(const Catalog &tables, const QString &servos) : SettingsWorld(tables, servos), catalog(tables) { }

    Result<Backup> backup(std::size_t index = 0)
    {
        const DevicePlace place = placeOf(servo(index));
        MortalLine line(bus, place.baudRate);
        Bus program(line, &stop);
        DirectContext context(program);
        bus.setLogging(true);
        bus.clearLog();
        const auto image = readForBackup(context, planBackupReading(place, servo(index).table()));
        if (!image)
            return tl::unexpected(image.error());
        const Found found{
            place.id, place.baudRate, place.modelNumber, static_cast<std::uint8_t>(servo(index).firmware()), false, {}};
        return backupOf(found, servo(index).model(), catalog.findOrRaw(found.modelNumber, found.firmware), *image,
                        QDateTime(QDate(2026, 11, 28), QTime(20, 30), Qt::UTC));
    }
    std::size_t packets() const ///< of the program, since the last backup or apply
    {
        return static_cast<std::size_t>(
            std::ranges::count_if(bus.log(), [](const sim::WireEntry &entry) { return entry.fromController; }));
    }
    Result<RestorePlan> plan(const Backup &file, const RestoreOptions &options = {}, std::size_t index = 0)
    {
        const auto now = backup(index);
        if (!now)
            return tl::unexpected(now.error());
        return planRestore(file, *now, placeOf(servo(index)), options);
    }

    const Catalog &catalog;
};

/// Why it isn't done, for a test that fails.
inline QString problemsOf(const Result<SettingsOutcome> &outcome)
{
    if (!outcome)
        return outcome.error().text;
    QStringList texts{outcome->why, outcome->ended ? outcome->ended->text : QString()};
    for (const SettingResult &result : outcome->results)
        texts << result.why;
    texts.removeAll(QString());
    return texts.join(QStringLiteral("; "));
}

} // namespace dynascope::test
