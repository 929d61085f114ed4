// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/loopbackserver.h"

#include <algorithm>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace dynascope;

LoopbackServer::LoopbackServer(bool ipv6)
    : m_listener(::socket(ipv6 ? AF_INET6 : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), m_ipv6(ipv6)
{
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    six.sin6_addr = in6addr_loopback;
    sockaddr_in four{};
    four.sin_family = AF_INET;
    four.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto *where = ipv6 ? reinterpret_cast<sockaddr *>(&six) : reinterpret_cast<sockaddr *>(&four);
    socklen_t size = ipv6 ? sizeof six : sizeof four;
    if (::bind(m_listener, where, size) != 0 || ::listen(m_listener, 1) != 0
        || ::getsockname(m_listener, where, &size) != 0)
        qFatal("no loopback server");
    m_port = ntohs(ipv6 ? six.sin6_port : four.sin_port);
}

LoopbackServer::~LoopbackServer()
{
    hangUp();
    stopListening();
}

QString LoopbackServer::address(const QString &scheme) const
{
    const QString host = m_ipv6 ? QStringLiteral("[::1]") : QStringLiteral("127.0.0.1");
    return QStringLiteral("%1://%2:%3").arg(scheme, host).arg(m_port);
}

bool LoopbackServer::wait(int descriptor) const
{
    pollfd entry{descriptor, POLLIN, 0};
    return ::poll(&entry, 1, 5000) == 1;
}

void LoopbackServer::accept()
{
    hangUp();
    if (!wait(m_listener) || (m_client = ::accept(m_listener, nullptr, nullptr)) < 0)
        qFatal("nobody connected");
}

void LoopbackServer::write(const Bytes &bytes)
{
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t some = ::send(m_client, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (some <= 0)
            return; // the client has gone: the test sees it from there
        sent += static_cast<std::size_t>(some);
    }
}

Bytes LoopbackServer::read(std::size_t bytes)
{
    Bytes all;
    while (all.size() < bytes && wait(m_client)) {
        Bytes some(bytes - all.size());
        const ssize_t got = ::recv(m_client, some.data(), some.size(), 0);
        if (got <= 0)
            break;
        all.insert(all.end(), some.begin(), some.begin() + got);
    }
    return all;
}

Bytes LoopbackServer::readUntil(const Bytes &end)
{
    Bytes all;
    while (all.size() < end.size() || !std::equal(end.rbegin(), end.rend(), all.rbegin())) {
        const Bytes one = read(1);
        if (one.empty())
            break;
        all.push_back(one.front());
    }
    return all;
}

void LoopbackServer::hangUp()
{
    if (m_client >= 0)
        ::close(std::exchange(m_client, -1));
}

void LoopbackServer::stopListening()
{
    if (m_listener >= 0)
        ::close(std::exchange(m_listener, -1));
}

bool LoopbackServer::hasIpv6()
{
    sockaddr_in6 where{};
    where.sin6_family = AF_INET6;
    where.sin6_addr = in6addr_loopback;
    const int probe = ::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool has = probe >= 0 && ::bind(probe, reinterpret_cast<sockaddr *>(&where), sizeof where) == 0;
    if (probe >= 0)
        ::close(probe);
    return has;
}

quint16 LoopbackServer::freePort()
{
    return LoopbackServer().m_port;
}

bool LoopbackServer::isListenedAt(quint16 port)
{
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    where.sin_port = htons(port);
    const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    // What a server left behind when it was killed is no listener.
    const int on = 1;
    ::setsockopt(probe, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const bool taken = ::bind(probe, reinterpret_cast<sockaddr *>(&where), sizeof where) != 0;
    ::close(probe);
    return taken;
}
