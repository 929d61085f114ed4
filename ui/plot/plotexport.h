// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "ui/plot/tracedata.h"

class QIODevice;
class QPixmap;

namespace dynascope {

/// What is seen, as comma-separated values in UTF-8: a line per moment at which something came, a column per visible
/// trace; seconds since the first line, physical values; empty where a trace has nothing at that moment. False where
/// not all of it could be written.
bool writeCsv(QIODevice &to, std::span<const TraceData> traces, LineTime from, LineTime end);

/// Replace `path` only when all has been written.
Result<void> saveCsv(const QString &path, std::span<const TraceData> traces, LineTime from, LineTime end);
Result<void> savePicture(const QString &path, const QPixmap &picture);

/// "dynascope 2026-05-04 17.03.59.csv"
QString suggestedFileName(const QString &suffix);

} // namespace dynascope
