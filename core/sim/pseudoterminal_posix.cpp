// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/pseudoterminal.h"

#include "core/sim/ptybaud.h"
#include "core/sim/systemfailure_posix.h"

#include <QFile>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

namespace dynascope::sim {
namespace {

constexpr int DefaultBaudRate = 57600;

bool makeRaw(int descriptor)
{
    termios settings{};
    if (tcgetattr(descriptor, &settings) != 0)
        return false;
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    cfsetspeed(&settings, B57600);
    return tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

/// A link that a simulator left behind does, though the terminal may be gone.
bool leadsToTerminal(const QByteArray &link)
{
    constexpr std::array<char, 9> folder{'/', 'd', 'e', 'v', '/', 'p', 't', 's', '/'};
    std::array<char, 128> target{};
    const ssize_t size = readlink(link.constData(), target.data(), target.size());
    return size > static_cast<ssize_t>(folder.size()) && std::equal(folder.begin(), folder.end(), target.begin());
}

} // namespace

Result<std::unique_ptr<PseudoTerminal>> PseudoTerminal::open(const QString &link)
{
    std::unique_ptr<PseudoTerminal> terminal(new PseudoTerminal);
    if (auto opened = terminal->openBoth(); !opened)
        return tl::unexpected(opened.error());
    if (!link.isEmpty()) {
        if (auto linked = terminal->makeLink(link); !linked)
            return tl::unexpected(linked.error());
    }
    return terminal;
}

Result<void> PseudoTerminal::openBoth()
{
    m_master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    std::array<char, 128> name{};
    if (m_master < 0 || grantpt(m_master) != 0 || unlockpt(m_master) != 0
        || ptsname_r(m_master, name.data(), name.size()) != 0)
        return systemFailure(QStringLiteral("No pseudo-terminal could be made"));
    m_path = QString::fromLocal8Bit(name.data());
    m_slave = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (m_slave < 0 || !makeRaw(m_slave))
        return systemFailure(QStringLiteral("%1 could not be set up").arg(m_path));
    m_watch = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (m_watch >= 0 && inotify_add_watch(m_watch, name.data(), IN_OPEN | IN_CLOSE) < 0) {
        ::close(m_watch);
        m_watch = -1;
    }
    return {};
}

Result<void> PseudoTerminal::makeLink(const QString &link)
{
    const QByteArray name = QFile::encodeName(link);
    struct stat found = {};
    const bool exists = lstat(name.constData(), &found) == 0;
    if (exists && !S_ISLNK(found.st_mode))
        return failure(ErrorKind::InvalidArgument, QStringLiteral("%1 exists and is not a symbolic link").arg(link));
    if (exists && !leadsToTerminal(name))
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("%1 exists and leads to something else than a pseudo-terminal").arg(link));
    // Replaced in one step: whoever opens it finds the old or the new one.
    const QByteArray fresh = name + ".new" + QByteArray::number(getpid());
    const QByteArray target = QFile::encodeName(m_path);
    ::unlink(fresh.constData());
    if (symlink(target.constData(), fresh.constData()) != 0 || rename(fresh.constData(), name.constData()) != 0) {
        const int why = errno;
        ::unlink(fresh.constData());
        errno = why;
        return systemFailure(QStringLiteral("The link %1 could not be made").arg(link));
    }
    m_link = link;
    return {};
}

PseudoTerminal::~PseudoTerminal()
{
    if (!m_link.isEmpty() && QFile::symLinkTarget(m_link) == m_path) // not one that came after us
        QFile::remove(m_link);
    for (const int descriptor : {m_watch, m_slave, m_master}) {
        if (descriptor >= 0)
            ::close(descriptor);
    }
}

int PseudoTerminal::baudRate() const
{
    const int rate = clientBaudRate(m_master);
    return rate > 0 ? rate : DefaultBaudRate;
}

Bytes PseudoTerminal::read()
{
    std::array<std::uint8_t, 4096> chunk{};
    Bytes bytes;
    for (;;) {
        const ssize_t count = ::read(m_master, chunk.data(), chunk.size());
        if (count > 0)
            bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + count);
        else if (count == 0 || errno != EINTR)
            return bytes;
    }
}

void PseudoTerminal::write(ByteView bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(m_master, bytes.data(), bytes.size());
        if (count > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return;
    }
}

bool PseudoTerminal::noticeClients()
{
    alignas(inotify_event) std::array<char, 4096> buffer{};
    const int before = m_clients;
    bool someoneLeft = false;
    for (;;) {
        const ssize_t count = ::read(m_watch, buffer.data(), buffer.size());
        if (count <= 0)
            break;
        for (ssize_t at = 0; at < count;) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            if (event.mask & IN_OPEN)
                ++m_clients;
            if (event.mask & IN_CLOSE) {
                m_clients = std::max(0, m_clients - 1);
                someoneLeft = true;
            }
            at += static_cast<ssize_t>(sizeof event) + event.len;
        }
    }
    if (m_clients > 0 || (!someoneLeft && before == 0))
        return false;
    // A client that was killed leaves the terminal exclusive for ever; and its answers are nobody's.
    ioctl(m_slave, TIOCNXCL);
    tcflush(m_slave, TCIFLUSH);
    return true;
}

} // namespace dynascope::sim
