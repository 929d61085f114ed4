// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/session/history.h"

#include <QString>

#include <atomic>
#include <vector>

class QIODevice;
class QPixmap;

namespace dynascope {

/// A trace as it goes into a file: samples of its own, so that any one thread may write them.
struct CsvColumn {
    QString title;
    double scale = 1; ///< physical = raw × scale + offset
    double offset = 0;
    int decimals = 0;
    std::vector<History::Sample> samples; ///< in the order of time
};

/// Comma-separated values in UTF-8: a line per moment at which something came, a column per trace; seconds since the
/// first line, physical values; empty where a trace has nothing at that moment. False where not all of it was written:
/// it could not be, or `cancelled` was set meanwhile, by any thread.
bool writeCsv(QIODevice &to, std::span<const CsvColumn> columns, const std::atomic<bool> &cancelled);

/// Replace `path` only when all has been written; Cancelled and BadFile leave what was there. Any one thread.
Result<void> saveCsv(const QString &path, std::span<const CsvColumn> columns, const std::atomic<bool> &cancelled);
Result<void> saveBytes(const QString &path, const QByteArray &bytes);
Result<void> savePicture(const QString &path, const QPixmap &picture); ///< GUI thread

/// "dynascope 2026-05-04 17.03.59.csv"
QString suggestedFileName(const QString &suffix);

} // namespace dynascope
