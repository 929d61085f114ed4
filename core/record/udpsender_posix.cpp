// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/udpsender_posix.h"

#include <cerrno>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

namespace dynascope::posix {

Result<UdpSender> UdpSender::open(const QString &place, Names names)
{
    const qsizetype colon = place.lastIndexOf(u':');
    QString host = place.left(qMax<qsizetype>(0, colon));
    bool isNumber = false;
    const int port = place.mid(colon + 1).toInt(&isNumber);
    const bool isBracketed = host.startsWith(u'[') && host.endsWith(u']') && host.size() > 2;
    if (isBracketed)
        host = host.sliced(1, host.size() - 2);
    if (!isNumber || port < 1 || port > 65'535 || (!isBracketed && host.contains(u':'))) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("\"%1\" names no place to send to: PORT (on this machine), HOST:PORT or [IPv6]:PORT")
                           .arg(place));
    }
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICSERV | (names == Names::Refuse ? AI_NUMERICHOST : 0);
    addrinfo *first = nullptr;
    const QByteArray name = host.isEmpty() || host == QStringLiteral("localhost") ? QByteArray("127.0.0.1") : host.toUtf8();
    const int error = ::getaddrinfo(name.constData(), QByteArray::number(port).constData(), &hints, &first);
    if (error != 0 && names == Names::Refuse) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("\"%1\" is no IP address, such as 192.168.1.20; names aren't looked up here").arg(host));
    }
    const std::unique_ptr<addrinfo, void (*)(addrinfo *)> addresses(error == 0 ? first : nullptr,
                                                                    [](addrinfo *a) { if (a) ::freeaddrinfo(a); });
    for (const addrinfo *one = addresses.get(); one; one = one->ai_next) {
        const int socket = ::socket(one->ai_family, SOCK_DGRAM, 0);
        if (socket < 0)
            continue;
        ::fcntl(socket, F_SETFD, FD_CLOEXEC);
        ::fcntl(socket, F_SETFL, O_NONBLOCK);
        if (::connect(socket, one->ai_addr, one->ai_addrlen) == 0)
            return UdpSender(socket);
        ::close(socket);
    }
    return failure(ErrorKind::NotFound, QStringLiteral("nobody knows where %1 is, or no way leads there").arg(place));
}

UdpSender::~UdpSender()
{
    if (m_socket >= 0)
        ::close(m_socket);
}

UdpSender::UdpSender(UdpSender &&other) noexcept
    : m_socket(std::exchange(other.m_socket, -1))
    , m_lost(other.m_lost)
{
}

void UdpSender::send(const QByteArray &datagram)
{
    const ssize_t sent = ::send(m_socket, datagram.constData(), static_cast<std::size_t>(datagram.size()), 0);
    // Refused: nobody listens there yet, which the datagram before this one found out; this one is another try.
    const bool isRetried = sent < 0 && errno == ECONNREFUSED
        && ::send(m_socket, datagram.constData(), static_cast<std::size_t>(datagram.size()), 0) >= 0;
    if (sent < 0 && !isRetried)
        ++m_lost;
}

} // namespace dynascope::posix
