// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>

namespace dynascope::posix {

/// Sends datagrams to one place, and never waits: what the system doesn't take at once is lost, and counted. One thread.
class UdpSender
{
public:
    static constexpr qsizetype LargestDatagram = 60'000; ///< bytes; the most there is is 65507

    /// "9870" and ":9870" (this machine), "HOST:9870", "[::1]:9870". HOST may be looked up, which may take a while.
    /// InvalidArgument: it is no such place; NotFound: nobody knows HOST.
    static Result<UdpSender> open(const QString &place);
    ~UdpSender();
    UdpSender(UdpSender &&other) noexcept;
    UdpSender &operator=(UdpSender &&) = delete;

    void send(const QByteArray &datagram);
    quint64 lost() const { return m_lost; }

private:
    explicit UdpSender(int socket) : m_socket(socket) { }

    int m_socket;
    quint64 m_lost = 0;
};

} // namespace dynascope::posix
