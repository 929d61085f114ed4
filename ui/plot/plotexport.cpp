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

/// A trace's samples that are still to be written.
struct Reader {
    const TraceData *trace;
    std::size_t next;
    std::size_t end;

    bool isDone() const { return next == end; }
    LineTime time() const { return trace->history->at(next).at; }
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
        if (!reader.isDone() && (!first || reader.time() < first->time()))
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

bool writeCsv(QIODevice &to, std::span<const TraceData> traces, LineTime from, LineTime end)
{
    std::vector<Reader> readers;
    QByteArray line = "Time (s)";
    for (const TraceData &trace : traces) {
        if (!trace.visible)
            continue;
        line +=
            ',' + quoted(trace.unit.isEmpty() ? trace.label : QStringLiteral("%1 (%2)").arg(trace.label, trace.unit));
        const bool hasAny = trace.isDrawn();
        readers.push_back(
            {&trace, hasAny ? trace.history->indexAt(from) : 0, hasAny ? trace.history->indexAt(end) : 0});
    }
    if (to.write(line + '\n') < 0)
        return false;
    const Reader *first = earliest(readers);
    const LineTime zero = first ? first->time() : LineTime{};
    while (first) {
        const LineTime now = first->time();
        line = QByteArray::number(std::chrono::duration<double>(now - zero).count(), 'f', 6);
        for (Reader &reader : readers) {
            line += ',';
            if (reader.isDone() || reader.time() != now)
                continue;
            line += QByteArray::number(
                reader.trace->value(reader.trace->history->at(reader.next).raw), 'f', reader.trace->decimals);
            ++reader.next; // a second one at the same moment gets a line of its own
        }
        if (to.write(line + '\n') < 0)
            return false;
        first = earliest(readers);
    }
    return true;
}

Result<void> saveCsv(const QString &path, std::span<const TraceData> traces, LineTime from, LineTime end)
{
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly))
        return notWritten(file);
    if (!writeCsv(file, traces, from, end) || !file.commit())
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
