// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controlsocket.h"

#include "core/sim/systemfailure_posix.h"

#include <QFile>
#include <QFileInfo>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace dynascope::sim {
namespace {

constexpr int Backlog = 8;
constexpr int Patience = 10'000;                     ///< ms, for an answer
constexpr qsizetype LongestAnswer = 16 * 1024 * 1024; ///< bytes

/// Ours alone: nobody else may put a socket of that name there.
bool isPrivateFolder(const QByteArray &path)
{
    struct stat found = {};
    return lstat(path.constData(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid()
        && (found.st_mode & 077) == 0;
}

QByteArray runtimeFolder()
{
    const QByteArray given = qgetenv("XDG_RUNTIME_DIR");
    if (!given.isEmpty() && isPrivateFolder(given))
        return given;
    const QByteArray own = "/tmp/dynascope-" + QByteArray::number(geteuid());
    mkdir(own.constData(), 0700);
    return own;
}

bool addressOf(const QByteArray &path, sockaddr_un &address)
{
    address = {};
    address.sun_family = AF_UNIX;
    if (path.size() >= static_cast<qsizetype>(sizeof address.sun_path))
        return false;
    std::memcpy(address.sun_path, path.constData(), static_cast<std::size_t>(path.size()));
    return true;
}

int connectTo(const QByteArray &path)
{
    sockaddr_un address{};
    if (!addressOf(path, address)) {
        errno = ENAMETOOLONG;
        return -1;
    }
    const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0 || connect(descriptor, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0)
        return descriptor;
    const int why = errno;
    ::close(descriptor);
    errno = why;
    return -1;
}

/// Nothing where the way is free now.
Result<void> clearWay(const QByteArray &path)
{
    const QString name = QFile::decodeName(path);
    struct stat found = {};
    if (lstat(path.constData(), &found) != 0)
        return {};
    if (!S_ISSOCK(found.st_mode))
        return failure(ErrorKind::InvalidArgument, QStringLiteral("%1 exists and is not a control socket").arg(name));
    const int answered = connectTo(path);
    if (answered >= 0) {
        ::close(answered);
        return failure(ErrorKind::PortBusy, QStringLiteral("Another simulator answers at %1").arg(name));
    }
    if (errno != ECONNREFUSED || ::unlink(path.constData()) != 0)
        return systemFailure(QStringLiteral("The control socket %1 could not be replaced").arg(name));
    return {};
}

} // namespace

QString controlSocketPath(const QString &linkOrTerminal)
{
    const QString terminals = QStringLiteral("/dev/pts/");
    if (!linkOrTerminal.startsWith(terminals))
        return linkOrTerminal + QStringLiteral(".ctl");
    const QString number = linkOrTerminal.mid(terminals.size()).replace(u'/', u'-');
    return QFile::decodeName(runtimeFolder()) + QStringLiteral("/pts-") + number + QStringLiteral(".ctl");
}

Result<std::unique_ptr<ControlSocket>> ControlSocket::listen(const QString &path)
{
    const QByteArray name = QFile::encodeName(path);
    const QByteArray folder = QFile::encodeName(QFileInfo(path).path());
    if (folder.startsWith("/tmp/dynascope-") && !isPrivateFolder(folder))
        return failure(ErrorKind::PortForbidden,
                       QStringLiteral("%1 is not this user's alone").arg(QFile::decodeName(folder)));
    sockaddr_un address{};
    if (!addressOf(name, address))
        return failure(ErrorKind::InvalidArgument, QStringLiteral("The path %1 is too long for a socket").arg(path));
    if (auto way = clearWay(name); !way)
        return tl::unexpected(way.error());
    std::unique_ptr<ControlSocket> made(new ControlSocket);
    made->m_descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    // The mode is the socket's before it has a name: there is no moment at which others may connect.
    if (made->m_descriptor < 0 || fchmod(made->m_descriptor, 0600) != 0
        || bind(made->m_descriptor, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0)
        return systemFailure(QStringLiteral("The control socket %1 could not be made").arg(path));
    made->m_path = name;
    if (chmod(name.constData(), 0600) != 0 || ::listen(made->m_descriptor, Backlog) != 0)
        return systemFailure(QStringLiteral("The control socket %1 could not be made").arg(path));
    return made;
}

ControlSocket::~ControlSocket()
{
    if (!m_path.isEmpty())
        ::unlink(m_path.constData());
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

int ControlSocket::accept()
{
    const int client = accept4(m_descriptor, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (client < 0)
        return -1;
    ucred who{};
    socklen_t size = sizeof who;
    if (getsockopt(client, SOL_SOCKET, SO_PEERCRED, &who, &size) == 0 && (who.uid == geteuid() || who.uid == 0))
        return client;
    ::close(client);
    return -1;
}

Result<QByteArray> askControl(const QString &linkOrTerminal, const QByteArray &line)
{
    QString path = controlSocketPath(linkOrTerminal);
    // A link to a terminal whose simulator was told of no link.
    const QString target = QFileInfo(linkOrTerminal).canonicalFilePath();
    if (!QFileInfo::exists(path) && target.startsWith(u"/dev/pts/"))
        path = controlSocketPath(target);
    const int descriptor = connectTo(QFile::encodeName(path));
    if (descriptor < 0) {
        if (errno == ENOENT || errno == ECONNREFUSED)
            return failure(ErrorKind::PortNotFound, QStringLiteral("No simulator serves %1: nobody answers at %2")
                                                        .arg(linkOrTerminal, path));
        return systemFailure(QStringLiteral("The simulator's control channel %1 can't be reached").arg(path));
    }
    const QByteArray sent = line + '\n';
    QByteArray answer;
    bool good =
        ::send(descriptor, sent.constData(), static_cast<std::size_t>(sent.size()), MSG_NOSIGNAL) == sent.size();
    while (good && !answer.endsWith('\n') && answer.size() < LongestAnswer) {
        pollfd waited{descriptor, POLLIN, 0};
        std::array<char, 65536> chunk{};
        good = poll(&waited, 1, Patience) > 0;
        const ssize_t count = good ? ::read(descriptor, chunk.data(), chunk.size()) : -1;
        good = count > 0;
        if (good)
            answer.append(chunk.data(), count);
    }
    ::close(descriptor);
    if (!answer.endsWith('\n'))
        return failure(ErrorKind::PortLost, QStringLiteral("The simulator at %1 did not answer").arg(linkOrTerminal));
    answer.chop(1);
    return answer;
}

} // namespace dynascope::sim
