// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/udpreceiver.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

UdpReceiver::UdpReceiver()
    : m_socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0))
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    if (::bind(m_socket, reinterpret_cast<sockaddr *>(&address), size) == 0
        && ::getsockname(m_socket, reinterpret_cast<sockaddr *>(&address), &size) == 0)
        m_port = ntohs(address.sin_port);
}

UdpReceiver::~UdpReceiver()
{
    if (m_socket >= 0)
        ::close(m_socket);
}

QByteArray UdpReceiver::take()
{
    QByteArray datagram(65'536, Qt::Uninitialized);
    const ssize_t size = ::recv(m_socket, datagram.data(), static_cast<std::size_t>(datagram.size()), 0);
    datagram.truncate(size > 0 ? static_cast<qsizetype>(size) : 0);
    return datagram;
}
