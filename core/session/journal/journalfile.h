// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>
#include <QLockFile>
#include <QString>

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace dynascope {

/// Lines in files that are only ever added to: journal-000001.jsonl, then the next once that is full, the oldest going.
/// Several programs may share a folder: each takes the lock for a line. What a crash left half written ends where the
/// next line begins. One thread.
class JournalFile
{
public:
    struct Bounds {
        qint64 fileSize = 4 * 1024 * 1024; ///< bytes; a file that has reached it is not added to
        int files = 4;
        qsizetype lineLength = 32 * 1024; ///< bytes; longer ones are skipped
    };
    JournalFile(QString folder, const Bounds &bounds);

    /// Held while a line is added. Fails with PortBusy where somebody holds it for longer than `patience`, with BadFile
    /// where the folder can't be written.
    Result<std::unique_ptr<QLockFile>> lock(std::chrono::milliseconds patience);

    /// The first read() begins with the newest lines, those in so many bytes at the end.
    void beginNearEnd(qint64 bytes);

    /// Hands over the whole lines that were added since the last call, by whatever program; at the first, all there
    /// are.
    void read(const std::function<void(const QByteArray &line)> &take);

    /// Under the lock, behind a read(). `line` has no line break. Flushed to the system before this returns.
    Result<void> append(const QByteArray &line);

private:
    std::vector<int> numbers() const; ///< of the files there are, ascending
    QString path(int number) const;
    bool readFile(int number, const std::function<void(const QByteArray &line)> &take);

    QString m_folder;
    Bounds m_bounds;
    int m_number = 0;    ///< of the file that was read last; 0: none
    qint64 m_offset = 0; ///< in it, behind the last whole line
};

} // namespace dynascope
