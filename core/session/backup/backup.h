// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/settings/readimages.h"
#include "core/table/catalog.h"
#include "core/table/units.h"

#include <QDateTime>

/// All registers of one device at one time, in a file or just read. resources/backups/FORMAT.md says how the file is
/// written. Values; any thread.
namespace dynascope {

struct BackupRegister {
    int field = -1; ///< index in the backup's table
    std::int64_t raw = 0;
    int line = 0, column = 0; ///< of the value in its file; 0: it was read from a device
};

/// Bytes that the table does not name.
struct BackupBytes {
    int address = 0;
    Bytes bytes;

    friend bool operator==(const BackupBytes &, const BackupBytes &) = default;
};

struct Backup {
    static constexpr int Version = 1;
    static constexpr std::size_t MostRegisters = 4096;
    static constexpr qsizetype MostBytes = 64; ///< of a line of the file

    QString file; ///< for messages; empty: it was read from a device
    int modelNumber = 0;
    QString model; ///< "XM430-W350"
    int firmware = 0;
    int id = 0;                            ///< where it stood then
    int baudRate = 0;                      ///< bits per second
    QDateTime at;                          ///< UTC
    ControlTablePtr table;                 ///< of this model and firmware; of an unknown model one of bare bytes
    std::vector<BackupRegister> registers; ///< by field
    std::vector<BackupBytes> bytes;        ///< by address
    QStringList unread;                    ///< registers that the device refused to show

    bool isKnownModel() const { return table && !table->description().isRaw; }
    const BackupRegister *find(const Field *field) const;
    const BackupRegister *find(QStringView name) const;
    const Field &fieldOf(const BackupRegister &one) const
    {
        return table->fields()[static_cast<std::size_t>(one.field)];
    }
    RegisterLookup lookup() const;                 ///< while this lives
    QString text(const BackupRegister &one) const; ///< "180.00 °"; the raw number where there is nothing better
    QString name() const;                          ///< "XM430-W350 (ID 1)"
};

/// @name From a device
/// @{
/// What is read, and which registers alone where a stretch of them is refused.
struct BackupReadPlan {
    ReadSpansPlan spans;
    std::vector<Span> registers;
};
BackupReadPlan planBackupReading(const DevicePlace &place, const ControlTable &table);
/// All registers in few exchanges. What the device refuses is left out. Errors: it fell silent, STOP, cancelled.
Result<RegisterImage> readForBackup(JobContext &context, const BackupReadPlan &plan);
/// `table`: Catalog::findOrRaw().
Backup backupOf(const Found &found, const QString &model, const ControlTablePtr &table, const RegisterImage &image,
                const QDateTime &at);
/// @}

/// @name As a file
/// @{
QByteArray toYaml(const Backup &backup);
/// Read with distrust: bounded, each register against its table. BadFile; the message has a line for each fault,
/// "name:line:column: sentence", ten at most.
Result<Backup> backupFromYaml(const QByteArray &yaml, const QString &name, const Catalog &catalog);
Result<Backup> loadBackup(const QString &path, const Catalog &catalog); ///< NotFound, BadFile
Result<void> saveBackup(const QString &path, const Backup &backup);     ///< at once or not at all
QString suggestedFileName(const Backup &backup);                        ///< "XM430-W350-id001-20261128-203000.yaml"
/// @}

} // namespace dynascope
