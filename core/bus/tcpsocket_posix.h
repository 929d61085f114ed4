// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/bus/networkaddress_values.h"

#include <atomic>

namespace dynascope::posix {

/// A TCP connection with waits as fine as ppoll's, without an event loop. One thread.
class TcpSocket
{
public:
    /// Looks the host up and connects within `limit`, each of its addresses in turn; looks at `cancel` every 20 ms.
    /// Fails with PortNotFound, Cancelled; `name` is for the messages.
    static Result<TcpSocket> connect(const QString &name, const NetworkAddress &address, LineTime limit,
                                     const std::atomic<bool> &cancel);

    TcpSocket(TcpSocket &&other) noexcept;
    TcpSocket &operator=(TcpSocket &&) = delete;
    ~TcpSocket();

    /// Time that connecting took: about one round trip.
    LineTime roundTrip() const { return m_roundTrip; }

    /// Hands everything to the system. False: the connection is lost, or nobody has read from it for so long that the
    /// system didn't take it within 200 ms.
    bool write(ByteView bytes);
    /// Appends what has come, 4 KiB at most; waits for the first byte until `deadline` on the monotonic clock. False:
    /// the connection is lost, and everything that came before has been read.
    bool read(Bytes &buffer, LineTime deadline);
    void close();

    static LineTime now(); ///< the monotonic clock

private:
    explicit TcpSocket(int descriptor) : m_descriptor(descriptor) { }

    int m_descriptor;
    LineTime m_roundTrip{};
};

} // namespace dynascope::posix
