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

    enum class Names { LookUp, Refuse }; ///< looking one up may take a while; "localhost" is never looked up

    /// "9870" and ":9870" (this machine), "HOST:9870", "[::1]:9870".
    /// InvalidArgument: it is no such place, or a name where none is wanted; NotFound: nobody knows HOST.
    static Result<UdpSender> open(const QString &place, Names names = Names::LookUp);
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
