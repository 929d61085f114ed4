// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/result.h"

namespace dynascope::posix {

/// A new file that is only appended to. What append() could not write whole is taken back, so that the file always ends
/// where a record ends. One thread at a time.
class RecordFile
{
public:
    /// BadFile: it is there already, or can't be made; the message says which folder, file, and why.
    static Result<RecordFile> create(const QString &path);
    ~RecordFile();
    RecordFile(RecordFile &&other) noexcept;
    RecordFile &operator=(RecordFile &&) = delete;

    const QString &path() const { return m_path; }
    qint64 size() const { return m_size; }

    Result<void> append(ByteView bytes); ///< BadFile
    Result<void> sync();                 ///< what was appended outlives a pulled plug; BadFile

private:
    RecordFile(QString path, int file) : m_path(std::move(path)), m_file(file) { }

    QString m_path;
    int m_file;
    qint64 m_size = 0;
};

} // namespace dynascope::posix
