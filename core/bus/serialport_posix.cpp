// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/serialport_posix.h"

#include "core/bus/messages.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/serial.h>
#endif

namespace dynascope::posix {
namespace {

/// What this process has open, as far as we may know.
QStringList filesOf(const QString &process)
{
    const QDir descriptors(QStringLiteral("/proc/%1/fd").arg(process));
    QStringList files;
    const QFileInfoList links = descriptors.entryInfoList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot);
    for (const QFileInfo &link : links)
        files << link.symLinkTarget();
    return files;
}

/// A simulator holds both ends of its pseudo-terminal; it is the wire, not who uses it.
bool isOtherEnd(const QStringList &files, const QString &path)
{
    return isPseudoTerminal(path)
           && std::ranges::any_of(files, [](const QString &file) { return file.endsWith(QLatin1String("/ptmx")); });
}

Error openError(const QString &name, const QString &path, int number)
{
    switch (number) {
    case ENOENT:
    case ENOTDIR: return messages::portNotFound(name);
    case ENXIO:
    case ENODEV: return messages::portEmpty(name);
    case EACCES:
    case EPERM: return messages::portForbidden(name);
    case EBUSY: return messages::portBusy(name, holderOf(path));
    case EISDIR: return messages::portNotSerial(name);
    case EIO: return messages::portLost(name);
    default: return messages::portFailed(name, QString::fromLocal8Bit(std::strerror(number)));
    }
}

} // namespace

QString holderOf(const QString &path)
{
#ifdef __linux__
    const QStringList processes = QDir(QStringLiteral("/proc")).entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    for (const QString &process : processes) {
        bool isNumber = false;
        const qint64 number = process.toLongLong(&isNumber);
        if (!isNumber || number == getpid())
            continue;
        const QStringList files = filesOf(process);
        if (!files.contains(path) || isOtherEnd(files, path))
            continue;
        QFile name(QStringLiteral("/proc/%1/comm").arg(process));
        const QByteArray program = name.open(QIODevice::ReadOnly) ? name.readAll().trimmed() : QByteArray();
        return messages::portHolder(QString::fromUtf8(program), process);
    }
    // Whoever asks may have tried to open it just now.
    if (filesOf(QString::number(getpid())).count(path) > 1)
        return messages::thisProgram();
#else
    Q_UNUSED(path)
#endif
    return {};
}

Result<PortGuard> PortGuard::take(const QString &name)
{
    const QString canonical = QFileInfo(name).canonicalFilePath();
    if (canonical.isEmpty())
        return tl::unexpected(messages::portNotFound(name));
    // Opened without waiting for a carrier, to see why it can't be opened: QSerialPort has one word for three reasons.
    const int descriptor = ::open(QFile::encodeName(canonical).constData(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return tl::unexpected(openError(name, canonical, errno));
    PortGuard guard(descriptor, canonical);
    if (::isatty(descriptor) == 0)
        return tl::unexpected(errno == EIO ? messages::portLost(name) : messages::portNotSerial(name));
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        return tl::unexpected(messages::portBusy(name, holderOf(canonical)));
    return guard;
}

PortGuard::PortGuard(PortGuard &&other) noexcept
    : m_descriptor(std::exchange(other.m_descriptor, -1)), m_path(std::move(other.m_path))
{
}

PortGuard::~PortGuard()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

Wait waitReadable(int descriptor, LineTime duration)
{
    pollfd entry{descriptor, POLLIN, 0};
    const auto nanoseconds = std::max<LineTime::rep>(0, duration.count());
#ifdef __linux__
    const timespec limit{
        static_cast<time_t>(nanoseconds / 1'000'000'000), static_cast<long>(nanoseconds % 1'000'000'000)};
    const int ready = ::ppoll(&entry, 1, &limit, nullptr);
#else
    const int ready = ::poll(&entry, 1, static_cast<int>((nanoseconds + 999'999) / 1'000'000));
#endif
    if (ready < 0)
        return errno == EINTR ? Wait::TimedOut : Wait::Lost;
    if (ready == 0)
        return Wait::TimedOut;
    if (entry.revents & POLLIN) // also beside a hang-up: what came before it can still be read
        return Wait::Readable;
    return Wait::Lost;
}

bool isPseudoTerminal(const QString &path)
{
    return path.startsWith(QLatin1String("/dev/pts/"));
}

static QString latencyFile(const QString &path)
{
    return QStringLiteral("/sys/bus/usb-serial/devices/%1/latency_timer").arg(QFileInfo(path).fileName());
}

bool lowerLatencyTimer(const QString &path)
{
    QFile file(latencyFile(path));
    return file.open(QIODevice::WriteOnly | QIODevice::Unbuffered | QIODevice::ExistingOnly) && file.write("1") == 1;
}

std::optional<LineTime> latencyTimer(const QString &path)
{
    QFile file(latencyFile(path));
    if (!file.open(QIODevice::ReadOnly))
        return std::nullopt;
    bool isNumber = false;
    const int milliseconds = file.readAll().trimmed().toInt(&isNumber);
    if (!isNumber || milliseconds < 0 || milliseconds > 255)
        return std::nullopt;
    return std::chrono::milliseconds(milliseconds);
}

bool setLowLatency(int descriptor)
{
#ifdef __linux__
    serial_struct settings{};
    if (::ioctl(descriptor, TIOCGSERIAL, &settings) != 0)
        return false;
    settings.flags |= ASYNC_LOW_LATENCY;
    return ::ioctl(descriptor, TIOCSSERIAL, &settings) == 0;
#else
    Q_UNUSED(descriptor)
    return false;
#endif
}

} // namespace dynascope::posix
