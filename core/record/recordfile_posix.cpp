// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recordfile_posix.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace dynascope::posix {
namespace {

QString reason(int error)
{
    switch (error) {
    case EEXIST: return QStringLiteral("it is there already, and is not written over");
    case EACCES:
    case EPERM:
    case EROFS: return QStringLiteral("this may not be written to");
    case ENOENT:
    case ENOTDIR: return QStringLiteral("there is no such folder");
    case ENOSPC:
    case EDQUOT: return QStringLiteral("the disk is full");
    case EFBIG: return QStringLiteral("this disk takes no file as large as that");
    default: return QString::fromLocal8Bit(std::strerror(error));
    }
}

tl::unexpected<Error> failed(const QString &path, int error)
{
    return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(QDir::toNativeSeparators(path), reason(error)));
}

} // namespace

Result<RecordFile> RecordFile::create(const QString &path)
{
    const int file = ::open(QFile::encodeName(path).constData(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
        const int error = errno;
        const bool aboutFolder = error == EACCES || error == EPERM || error == EROFS || error == ENOENT;
        return failed(aboutFolder ? QFileInfo(path).absolutePath() : path, error);
    }
    return RecordFile(path, file);
}

RecordFile::~RecordFile()
{
    if (m_file >= 0)
        ::close(m_file);
}

RecordFile::RecordFile(RecordFile &&other) noexcept
    : m_path(std::move(other.m_path))
    , m_file(std::exchange(other.m_file, -1))
    , m_size(other.m_size)
{
}

Result<void> RecordFile::append(ByteView bytes)
{
    ByteView rest = bytes;
    while (!rest.empty()) {
        const ssize_t written = ::write(m_file, rest.data(), rest.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0) {
            const int error = written < 0 ? errno : ENOSPC;
            if (::ftruncate(m_file, m_size) == 0)
                ::lseek(m_file, m_size, SEEK_SET);
            return failed(m_path, error);
        }
        rest = rest.subspan(static_cast<std::size_t>(written));
    }
    m_size += static_cast<qint64>(bytes.size());
    return {};
}

Result<void> RecordFile::sync()
{
    // EINVAL, EROFS: a pipe or a file system that has no such thing.
    while (::fdatasync(m_file) != 0) {
        if (errno == EINVAL || errno == EROFS || errno == ENOSYS)
            return {};
        if (errno != EINTR)
            return failed(m_path, errno);
    }
    return {};
}

} // namespace dynascope::posix
