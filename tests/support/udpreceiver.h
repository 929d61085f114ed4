// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>

/// Listens on a port of loopback that was free. POSIX.
class UdpReceiver
{
public:
    UdpReceiver();
    ~UdpReceiver();
    UdpReceiver(const UdpReceiver &) = delete;
    UdpReceiver &operator=(const UdpReceiver &) = delete;

    int port() const { return m_port; }
    QByteArray take(); ///< the next datagram; empty where none has come

private:
    int m_socket = -1;
    int m_port = 0;
};
