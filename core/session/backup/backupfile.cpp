// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/backup.h"
#include "core/session/texts.h"
#include "core/yaml/yamledit.h"
#include "core/yaml/yamltree.h"

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

#include <algorithm>

namespace dynascope {
namespace {

constexpr qsizetype CommentColumn = 36;

/// "  Operating Mode: 3                 # Position control"
QByteArray lineOf(const Backup &backup, const BackupRegister &one)
{
    const QString number = QString::number(one.raw);
    QByteArray line = "  " + yamlScalar(backup.fieldOf(one).name) + ": " + number.toLatin1();
    QString text = backup.text(one);
    if (text == number)
        return line + '\n';
    for (QChar &c : text) {
        if (!c.isPrint() && !c.isSurrogate())
            c = u' ';
    }
    return line.leftJustified(CommentColumn) + " # " + text.toUtf8() + '\n';
}

QByteArray sectionOf(const Backup &backup, const char *name, bool isWritable)
{
    QByteArray lines;
    for (const BackupRegister &one : backup.registers) {
        if ((backup.fieldOf(one).access != Access::Read) == isWritable)
            lines += lineOf(backup, one);
    }
    return lines.isEmpty() ? lines : QByteArray(name) + ":\n" + lines;
}

} // namespace

QByteArray toYaml(const Backup &backup)
{
    const QByteArray time = backup.at.toString(Qt::ISODate).toLatin1();
    QByteArray yaml = "# All registers of a device, as they were at this time. To restore: dxl restore ID FILE\n";
    yaml += "backup: " + QByteArray::number(Backup::Version) + '\n';
    yaml += "model: " + yamlScalar(backup.model) + '\n';
    yaml += "model-number: " + QByteArray::number(backup.modelNumber) + '\n';
    yaml += "firmware: " + QByteArray::number(backup.firmware) + '\n';
    yaml += "id: " + QByteArray::number(backup.id) + '\n';
    yaml += "baud: " + QByteArray::number(backup.baudRate) + '\n';
    yaml += "date: " + time + '\n';
    yaml += sectionOf(backup, "registers", true);
    const QByteArray readings = sectionOf(backup, "readings", false);
    if (!readings.isEmpty())
        yaml += "# What can only be read, as it was then:\n" + readings;
    if (!backup.bytes.empty())
        yaml += "# Bytes that no register is known for, by address:\nbytes:\n";
    for (const BackupBytes &one : backup.bytes) {
        const QByteArray raw(reinterpret_cast<const char *>(one.bytes.data()),
                             static_cast<qsizetype>(one.bytes.size()));
        yaml += "  " + QByteArray::number(one.address) + ": '" + raw.toHex(' ') + "'\n";
    }
    return yaml;
}

Result<Backup> loadBackup(const QString &path, const Catalog &catalog)
{
    QFile file(path);
    if (QFileInfo(path).isDir())
        return failure(ErrorKind::BadFile, BackupText::tr("%1 is a folder").arg(path));
    if (!file.open(QIODevice::ReadOnly)) {
        return failure(file.exists() ? ErrorKind::BadFile : ErrorKind::NotFound,
                       BackupText::tr("%1: %2").arg(path, file.errorString()));
    }
    return backupFromYaml(file.read(MaximumYamlSize + 1), path, catalog); // a byte too many is refused
}

Result<void> saveBackup(const QString &path, const Backup &backup)
{
    QSaveFile file(path);
    const QByteArray yaml = toYaml(backup);
    if (!file.open(QIODevice::WriteOnly) || file.write(yaml) != yaml.size() || !file.commit())
        return failure(ErrorKind::BadFile, BackupText::tr("%1 can't be written: %2").arg(path, file.errorString()));
    return {};
}

QString suggestedFileName(const Backup &backup)
{
    QString model = backup.model;
    for (QChar &c : model) {
        if (!c.isLetterOrNumber() && c != u'-')
            c = u'-';
    }
    return QStringLiteral("%1-id%2-%3.yaml")
        .arg(model)
        .arg(backup.id, 3, 10, QLatin1Char('0'))
        .arg(backup.at.toString(QStringLiteral("yyyyMMdd-HHmmss")));
}

} // namespace dynascope
