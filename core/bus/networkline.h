// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/networklinefactory.h"
#include "core/bus/rfc2217.h"
#include "core/bus/tcpsocket_posix.h"

namespace dynascope {

/// A serial port behind a server on the network. As raw bytes the rate is the server's; through RFC 2217 it is set, and
/// taken for set only once the server has confirmed it. A lost connection is a lost port. Blocking, without an event
/// loop, on the thread that opened it.
class NetworkLine final : public Line
{
public:
    /// Fails with PortNotFound, PortBusy, PortUnsuitable, Cancelled. With raw bytes `baudRate` is what the server is
    /// believed to work at, unless the name says it.
    static Result<std::unique_ptr<NetworkLine>> open(const QString &name, int baudRate, const NetworkOptions &options,
                                                     const std::atomic<bool> &cancel);
    ~NetworkLine() override;

    QString name() const override { return m_name; }
    LineTime now() const override { return posix::TcpSocket::now(); }
    Result<void> write(ByteView packet) override;
    Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return m_baudRate; }
    /// Waits for the server's word, 1.2 s at most; once more as long to return to the old rate where the server can't
    /// make the new one.
    Result<void> setBaudRate(int bitsPerSecond) override;
    bool canSetBaudRate() const override { return m_control.has_value(); }
    LineTime hostAllowance() const override { return m_hostAllowance; }

private:
    NetworkLine(QString name, posix::TcpSocket socket, const NetworkOptions &options);

    Result<void> start(const NetworkAddress &address, int baudRate, const std::atomic<bool> &cancel);
    Result<void> agree(Bytes &greetings, const std::atomic<bool> &cancel);
    bool receive(Bytes &buffer, LineTime deadline);
    bool send(ByteView bytes);
    Result<void> setRate(int bitsPerSecond, const std::atomic<bool> &cancel);
    std::optional<int> request(int bitsPerSecond, const std::atomic<bool> &cancel);
    Result<void> lose(const Error &why);

    QString m_name;
    posix::TcpSocket m_socket;
    std::optional<Rfc2217> m_control; ///< none: raw bytes
    int m_baudRate = 57600;
    LineTime m_hostAllowance{};
    LineTime m_drainedBy{}; ///< when the last packet has surely left the server's port, if nothing answers before
    Bytes m_raw;            ///< as it came, Telnet's commands included
    Bytes m_answer;
    Bytes m_waiting; ///< came while a rate was confirmed
    std::optional<Error> m_lost;
};

} // namespace dynascope
