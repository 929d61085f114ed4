// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotexport.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QPixmap>
#include <QSaveFile>

#include <algorithm>
#include <vector>

namespace dynascope {

namespace {

/// The context of what is translated here.
class PlotExport
{
    Q_DECLARE_TR_FUNCTIONS(PlotExport)
};

/// A column's samples that are still to be written.
struct Reader {
    const CsvColumn *column;
    std::size_t next = 0;

    bool isDone() const { return next == column->samples.size(); }
    const History::Sample &sample() const { return column->samples[next]; }
};

QByteArray quoted(const QString &text)
{
    QByteArray bytes = text.toUtf8();
    if (!bytes.contains(',') && !bytes.contains('"') && !bytes.contains('\n'))
        return bytes;
    return '"' + bytes.replace("\"", "\"\"") + '"';
}

/// The earliest moment that is left; nothing where all are done.
const Reader *earliest(const std::vector<Reader> &readers)
{
    const Reader *first = nullptr;
    for (const Reader &reader : readers) {
        if (!reader.isDone() && (!first || reader.sample().at < first->sample().at))
            first = &reader;
    }
    return first;
}

tl::unexpected<Error> notWritten(const QFileDevice &file)
{
    const QString path = QDir::toNativeSeparators(file.fileName());
    const bool hasReason = file.error() != QFileDevice::NoError && !file.errorString().isEmpty();
    return failure(ErrorKind::BadFile,
        hasReason ? PlotExport::tr("%1 could not be written: %2").arg(path, file.errorString())
                  : PlotExport::tr("%1 could not be written").arg(path));
}

} // namespace

bool writeCsv(QIODevice &to, std::span<const CsvColumn> columns, const std::atomic<bool> &cancelled)
{
    std::vector<Reader> readers;
    QByteArray line = "Time (s)";
    for (const CsvColumn &column : columns) {
        line += ',' + quoted(column.title);
        readers.push_back({&column});
    }
    if (to.write(line + '\n') < 0)
        return false;
    const Reader *first = earliest(readers);
    const LineTime zero = first ? first->sample().at : LineTime{};
    while (first) {
        const LineTime now = first->sample().at;
        line = QByteArray::number(std::chrono::duration<double>(now - zero).count(), 'f', 6);
        for (Reader &reader : readers) {
            line += ',';
            if (reader.isDone() || reader.sample().at != now)
                continue;
            const CsvColumn &column = *reader.column;
            line += QByteArray::number(reader.sample().raw * column.scale + column.offset, 'f', column.decimals);
            ++reader.next; // a second one at the same moment gets a line of its own
        }
        if (cancelled || to.write(line + '\n') < 0)
            return false;
        first = earliest(readers);
    }
    return true;
}

Result<void> saveCsv(const QString &path, std::span<const CsvColumn> columns, const std::atomic<bool> &cancelled)
{
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly))
        return notWritten(file);
    const bool isWhole = writeCsv(file, columns, cancelled);
    if (cancelled) {
        return failure(ErrorKind::Cancelled, PlotExport::tr("%1 was not written: saving was cancelled")
                                                 .arg(QDir::toNativeSeparators(path)));
    }
    if (!isWhole || !file.commit())
        return notWritten(file);
    return {};
}

Result<void> saveBytes(const QString &path, const QByteArray &bytes)
{
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
        return notWritten(file);
    return {};
}

Result<void> savePicture(const QString &path, const QPixmap &picture)
{
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly))
        return notWritten(file);
    if (!picture.save(&file, "PNG") || !file.commit())
        return notWritten(file);
    return {};
}

QString suggestedFileName(const QString &suffix)
{
    return QStringLiteral("dynascope %1.%2")
        .arg(QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd HH.mm.ss")), suffix);
}

} // namespace dynascope
