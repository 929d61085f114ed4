// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/seriallinefactory.h"
#include "core/bus/serialport_posix.h"

QT_BEGIN_NAMESPACE
class QSerialPort;
QT_END_NAMESPACE

namespace dynascope {

/// A serial port, for this program alone. Blocking, without an event loop, on the thread that opened it, which must be
/// a QThread.
class SerialLine final : public Line
{
public:
    /// Fails with PortNotFound, PortForbidden, PortBusy, PortUnsuitable.
    static Result<std::unique_ptr<SerialLine>> open(const QString &name, int baudRate, const SerialOptions &options);
    ~SerialLine() override;

    QString name() const override { return m_name; }
    LineTime now() const override;
    Result<void> write(ByteView packet) override;
    Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return m_baudRate; }
    Result<void> setBaudRate(int bitsPerSecond) override;
    LineTime hostAllowance() const override { return m_hostAllowance; }
    std::optional<LineTime> latencyTimer() const override { return m_latencyTimer; }
    Result<void> lowerLatency() override;

private:
    SerialLine(QString name, posix::PortGuard guard);

    Result<void> start(int baudRate, const SerialOptions &options);
    Result<void> lose();
    bool isFine();
    bool take(Bytes &buffer);

    QString m_name;
    posix::PortGuard m_guard;
    std::unique_ptr<QSerialPort> m_port;
    int m_baudRate = 57600;
    LineTime m_hostAllowance{};
    std::optional<LineTime> m_latencyTimer;
    bool m_lost = false;
};

} // namespace dynascope
