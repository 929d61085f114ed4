// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/serialline.h"

#include "core/bus/messages.h"

#include <QSerialPort>

#include <algorithm>
#include <cmath>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime Scheduling = 5ms;      ///< what a desktop may let a thread wait
constexpr LineTime UnknownAdapter = 16ms; ///< FTDI's default latency timer
constexpr LineTime PseudoTerminal = 50ms; ///< another process answers
constexpr int WriteTimeout = 200;         ///< ms without a byte taken: a stuck driver; STOP and closing wait as long

LineTime defaultAllowance(const QString &path)
{
    if (posix::isPseudoTerminal(path))
        return PseudoTerminal;
    return posix::latencyTimer(path).value_or(UnknownAdapter) + Scheduling;
}

} // namespace

SerialLine::SerialLine(QString name, posix::PortGuard guard)
    : m_name(std::move(name)), m_guard(std::move(guard)), m_port(std::make_unique<QSerialPort>())
{
}

SerialLine::~SerialLine() = default;

Result<std::unique_ptr<SerialLine>> SerialLine::open(const QString &name, int baudRate, const SerialOptions &options)
{
    Result<posix::PortGuard> guard = posix::PortGuard::take(name);
    if (!guard)
        return tl::unexpected(guard.error());
    std::unique_ptr<SerialLine> line(new SerialLine(name, std::move(*guard)));
    if (Result<void> started = line->start(baudRate, options); !started)
        return tl::unexpected(started.error());
    return line;
}

Result<void> SerialLine::start(int baudRate, const SerialOptions &options)
{
    m_port->setPortName(m_guard.path());
    m_port->setBaudRate(57600);
    if (!m_port->open(QIODevice::ReadWrite)) {
        // The guard could open it: what is left is somebody's lock file, or a driver's own reason.
        if (m_port->error() == QSerialPort::PermissionError)
            return tl::unexpected(messages::portBusy(m_name, posix::holderOf(m_guard.path())));
        return tl::unexpected(messages::portFailed(m_name, m_port->errorString()));
    }
    m_port->setDataBits(QSerialPort::Data8);
    m_port->setParity(QSerialPort::NoParity);
    m_port->setStopBits(QSerialPort::OneStop);
    m_port->setFlowControl(QSerialPort::NoFlowControl);
    m_port->clearError();
    posix::setLowLatency(static_cast<int>(m_port->handle())); // best effort: CDC-ACM adapters refuse it
    m_latencyTimer = posix::latencyTimer(m_guard.path());
    m_hostAllowance = options.hostAllowance.value_or(defaultAllowance(m_guard.path()));
    if (Result<void> set = setBaudRate(baudRate); !set)
        return set;
    discardInput();
    return {};
}

Result<void> SerialLine::lowerLatency()
{
    if (m_lost)
        return lose();
    const QString path = m_guard.path();
    const bool driver = posix::setLowLatency(static_cast<int>(m_port->handle()));
    m_latencyTimer = posix::latencyTimer(path);
    if (m_latencyTimer && *m_latencyTimer > 1ms && posix::lowerLatencyTimer(path))
        m_latencyTimer = posix::latencyTimer(path);
    if (m_latencyTimer ? *m_latencyTimer <= 1ms : driver)
        return {};
    return tl::unexpected(m_latencyTimer ? messages::latencyRefused(m_name, path, *m_latencyTimer)
                                         : messages::noLatencyTimer(m_name));
}

LineTime SerialLine::now() const
{
    return std::chrono::duration_cast<LineTime>(std::chrono::steady_clock::now().time_since_epoch());
}

Result<void> SerialLine::write(ByteView packet)
{
    if (m_lost)
        return lose();
    const auto size = static_cast<qint64>(packet.size());
    if (m_port->write(reinterpret_cast<const char *>(packet.data()), size) != size)
        return lose();
    // Into the kernel, not onto the wire.
    while (m_port->bytesToWrite() > 0) {
        if (!m_port->flush() && !m_port->waitForBytesWritten(WriteTimeout))
            return lose();
        if (!isFine())
            return lose();
    }
    return {};
}

Result<void> SerialLine::read(Bytes &buffer, LineTime deadline)
{
    if (m_lost)
        return lose();
    for (;;) {
        if (take(buffer))
            return {};
        const LineTime wait = std::max(LineTime(0), deadline - now());
        // QSerialPort waits in whole milliseconds; a reply may be due in a fraction of one.
        switch (posix::waitReadable(static_cast<int>(m_port->handle()), wait)) {
        case posix::Wait::TimedOut:
            if (now() >= deadline)
                return {};
            break;
        case posix::Wait::Readable:
            // Readable and yet nothing to read: the other end has hung up.
            if (!m_port->waitForReadyRead(0) || !isFine()) {
                if (take(buffer))
                    return {};
                return lose();
            }
            break;
        case posix::Wait::Lost: return lose();
        }
    }
}

bool SerialLine::take(Bytes &buffer)
{
    const qint64 available = m_port->bytesAvailable();
    if (available <= 0)
        return false;
    const std::size_t before = buffer.size();
    buffer.resize(before + static_cast<std::size_t>(available));
    const qint64 got = m_port->read(reinterpret_cast<char *>(buffer.data() + before), available);
    buffer.resize(before + static_cast<std::size_t>(std::max<qint64>(0, got)));
    return got > 0;
}

void SerialLine::discardInput()
{
    if (!m_lost)
        m_port->clear(QSerialPort::Input);
}

Result<void> SerialLine::setBaudRate(int bitsPerSecond)
{
    if (m_lost)
        return lose();
    const int before = m_baudRate;
    int made = 0;
    if (m_port->setBaudRate(bitsPerSecond)) {
        made = posix::actualBaudRate(static_cast<int>(m_port->handle())).value_or(bitsPerSecond);
        if (std::abs(made - bitsPerSecond) <= UartTolerance * bitsPerSecond) {
            m_baudRate = bitsPerSecond;
            return {};
        }
    }
    if (m_port->error() == QSerialPort::ResourceError)
        return lose();
    m_port->clearError();
    if (!m_port->setBaudRate(before))
        return lose(); // nobody knows its rate now
    return tl::unexpected(messages::rateRefused(m_name, bitsPerSecond, made));
}

/// A silent wait leaves TimeoutError behind, which is none.
bool SerialLine::isFine()
{
    switch (m_port->error()) {
    case QSerialPort::NoError: return true;
    case QSerialPort::TimeoutError: m_port->clearError(); return true;
    default: return false;
    }
}

/// Closed at once: waits on a port that is gone return immediately and would burn a core.
Result<void> SerialLine::lose()
{
    if (!m_lost) {
        m_lost = true;
        m_port->close();
    }
    return tl::unexpected(messages::portLost(m_name));
}

bool SerialLineFactory::knows(const QString &name) const
{
    return name.startsWith(QLatin1Char('/')) || name.startsWith(QLatin1String("COM"));
}

Result<std::unique_ptr<Line>> SerialLineFactory::open(const QString &name, int baudRate)
{
    Result<std::unique_ptr<SerialLine>> line = SerialLine::open(name, baudRate, m_options);
    if (!line)
        return tl::unexpected(line.error());
    return std::unique_ptr<Line>(std::move(*line));
}

} // namespace dynascope
