// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/tcpsocket_posix.h"

#include "core/bus/messages.h"
#include "core/bus/serialport_posix.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace dynascope::posix {
namespace {

using namespace std::chrono_literals;

constexpr LineTime CancelInterval = 20ms;
constexpr LineTime WriteLimit = 200ms; ///< a packet that the system doesn't take that long: nobody reads it any more
constexpr std::size_t ReadAtMost = 4096;
#ifdef MSG_NOSIGNAL
constexpr int SendFlags = MSG_NOSIGNAL;
#else
constexpr int SendFlags = 0; // SO_NOSIGPIPE stands for it
#endif

using Addresses = std::shared_ptr<addrinfo>;

struct Lookup {
    int error = 0;
    Addresses addresses;
};

Lookup lookUp(const std::string &host, const std::string &port, int flags)
{
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = flags | AI_NUMERICSERV;
    addrinfo *first = nullptr;
    const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &first);
    return {error, error == 0 ? Addresses(first, ::freeaddrinfo) : Addresses()};
}

/// A name server may take half a minute to say nothing, and getaddrinfo can't be ended: it has its own thread, that
/// is left behind where nobody wants to know any more.
Result<Addresses> resolve(const QString &name, const NetworkAddress &address, LineTime deadline,
                          const std::atomic<bool> &cancel)
{
    const std::string host = address.host.toStdString();
    const std::string port = std::to_string(address.port);
    if (Lookup numeric = lookUp(host, port, AI_NUMERICHOST); numeric.error == 0)
        return numeric.addresses;
    std::packaged_task<Lookup()> task([host, port] { return lookUp(host, port, AI_ADDRCONFIG); });
    std::future<Lookup> answer = task.get_future();
    std::thread(std::move(task)).detach();
    while (answer.wait_for(CancelInterval) != std::future_status::ready) {
        if (cancel.load(std::memory_order_acquire))
            return tl::unexpected(messages::cancelled());
        if (TcpSocket::now() >= deadline)
            return tl::unexpected(messages::nameServerSilent(name, address.host));
    }
    if (cancel.load(std::memory_order_acquire))
        return tl::unexpected(messages::cancelled());
    Lookup found = answer.get();
    if (found.error == 0)
        return found.addresses;
    if (found.error == EAI_AGAIN)
        return tl::unexpected(messages::nameServerSilent(name, address.host));
    return tl::unexpected(messages::hostUnknown(name, address.host));
}

/// Why no connection came about; 0: it did.
int connectTo(int descriptor, const addrinfo &to, LineTime deadline, const std::atomic<bool> &cancel)
{
    if (::connect(descriptor, to.ai_addr, to.ai_addrlen) == 0)
        return 0;
    if (errno != EINPROGRESS && errno != EINTR)
        return errno;
    for (;;) {
        pollfd entry{descriptor, POLLOUT, 0};
        const int ready = ::poll(&entry, 1, static_cast<int>(CancelInterval / 1ms));
        if (ready < 0 && errno != EINTR)
            return errno;
        if (ready > 0)
            break;
        if (cancel.load(std::memory_order_acquire))
            return ECANCELED;
        if (TcpSocket::now() >= deadline)
            return ETIMEDOUT;
    }
    int error = 0;
    socklen_t size = sizeof error;
    return ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

/// On loopback, where nobody listens, a connection may by chance meet itself.
bool isConnectedToItself(int descriptor)
{
    sockaddr_storage here{}, there{};
    socklen_t sizeHere = sizeof here, sizeThere = sizeof there;
    return ::getsockname(descriptor, reinterpret_cast<sockaddr *>(&here), &sizeHere) == 0
           && ::getpeername(descriptor, reinterpret_cast<sockaddr *>(&there), &sizeThere) == 0 && sizeHere == sizeThere
           && std::memcmp(&here, &there, sizeHere) == 0;
}

Error connectError(const QString &name, const NetworkAddress &address, int error, LineTime limit)
{
    switch (error) {
    case ECANCELED: return messages::cancelled();
    case ECONNREFUSED: return messages::connectionRefused(name);
    case ETIMEDOUT: return messages::hostSilent(name, address.host, limit);
    default: return messages::hostUnreachable(name, address.host, QString::fromLocal8Bit(std::strerror(error)));
    }
}

int openSocket(const addrinfo &to)
{
    const int descriptor = ::socket(to.ai_family, to.ai_socktype, to.ai_protocol);
    if (descriptor < 0)
        return descriptor;
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
    const int on = 1;
    // A packet must not wait for the acknowledgement of the one before it.
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(descriptor, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
#ifdef SO_NOSIGPIPE
    ::setsockopt(descriptor, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
#endif
#ifdef __linux__
    // Who pulls a network cable sends no farewell: silence is asked after, and taken for the end after some 10 s.
    const int idle = 4, interval = 2, count = 3, unacknowledged = 5000;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPCNT, &count, sizeof count);
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, &unacknowledged, sizeof unacknowledged);
#endif
    return descriptor;
}

} // namespace

LineTime TcpSocket::now()
{
    return std::chrono::duration_cast<LineTime>(std::chrono::steady_clock::now().time_since_epoch());
}

Result<TcpSocket> TcpSocket::connect(const QString &name, const NetworkAddress &address, LineTime limit,
                                     const std::atomic<bool> &cancel)
{
    const LineTime deadline = now() + limit;
    const Result<Addresses> addresses = resolve(name, address, deadline, cancel);
    if (!addresses)
        return tl::unexpected(addresses.error());
    int left = 0;
    for (const addrinfo *each = addresses->get(); each; each = each->ai_next)
        ++left;
    int error = EHOSTUNREACH;
    for (const addrinfo *each = addresses->get(); each && error != ECANCELED; each = each->ai_next, --left) {
        const LineTime begin = now();
        TcpSocket socket(openSocket(*each));
        error = socket.m_descriptor < 0
                    ? errno
                    : connectTo(socket.m_descriptor, *each, begin + (deadline - begin) / left, cancel);
        if (error == 0 && isConnectedToItself(socket.m_descriptor))
            error = ECONNREFUSED;
        if (error == 0) {
            socket.m_roundTrip = now() - begin;
            return socket;
        }
    }
    return tl::unexpected(connectError(name, address, error, limit));
}

TcpSocket::TcpSocket(TcpSocket &&other) noexcept
    : m_descriptor(std::exchange(other.m_descriptor, -1)), m_roundTrip(other.m_roundTrip)
{
}

TcpSocket::~TcpSocket()
{
    close();
}

void TcpSocket::close()
{
    if (m_descriptor >= 0)
        ::close(std::exchange(m_descriptor, -1));
}

bool TcpSocket::write(ByteView bytes)
{
    const LineTime deadline = now() + WriteLimit;
    while (m_descriptor >= 0 && !bytes.empty()) {
        const ssize_t sent = ::send(m_descriptor, bytes.data(), bytes.size(), SendFlags);
        if (sent > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
            continue;
        }
        if (errno == EINTR)
            continue;
        if ((errno != EAGAIN && errno != EWOULDBLOCK) || now() >= deadline)
            return false;
        pollfd entry{m_descriptor, POLLOUT, 0};
        ::poll(&entry, 1, static_cast<int>(CancelInterval / 1ms));
    }
    return m_descriptor >= 0;
}

bool TcpSocket::read(Bytes &buffer, LineTime deadline)
{
    while (m_descriptor >= 0) {
        const std::size_t before = buffer.size();
        buffer.resize(before + ReadAtMost);
        const ssize_t got = ::recv(m_descriptor, buffer.data() + before, ReadAtMost, 0);
        const int error = errno;
        buffer.resize(before + static_cast<std::size_t>(std::max<ssize_t>(0, got)));
        if (got > 0)
            return true;
        if (got == 0 || (error != EAGAIN && error != EWOULDBLOCK && error != EINTR))
            return false;
        const LineTime wait = deadline - now();
        if (wait <= LineTime(0))
            return true;
        // Lost here may be an end with bytes before it: recv tells.
        (void)waitReadable(m_descriptor, wait);
    }
    return false;
}

} // namespace dynascope::posix
