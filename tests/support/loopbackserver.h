// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <QString>

/// A TCP server on loopback for one client at a time, driven step by step by the test: what a serial server is to
/// NetworkLine. POSIX.
class LoopbackServer
{
public:
    explicit LoopbackServer(bool ipv6 = false);
    ~LoopbackServer();
    LoopbackServer(const LoopbackServer &) = delete;
    LoopbackServer &operator=(const LoopbackServer &) = delete;

    QString address(const QString &scheme) const; ///< "tcp://127.0.0.1:40123"
    void accept();                                ///< waits for a client, 5 s at most
    void write(const dynascope::Bytes &bytes);
    dynascope::Bytes read(std::size_t bytes); ///< waits for as many, 5 s at most
    dynascope::Bytes readUntil(const dynascope::Bytes &end);
    void hangUp();
    void stopListening();

    static bool hasIpv6();                  ///< containers may be without
    static quint16 freePort();              ///< nobody listens there now
    static bool isListenedAt(quint16 port); ///< found out without connecting

private:
    bool wait(int descriptor) const;

    int m_listener = -1;
    int m_client = -1;
    bool m_ipv6;
    quint16 m_port = 0;
};
