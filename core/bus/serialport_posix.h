// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <optional>

/// What QSerialPort doesn't do, on POSIX systems. Any thread.
namespace dynascope::posix {

/// Holds a port for this program alone as long as it lives: a lock on the device itself, which also binds root and a
/// second user of the port in this same program.
class PortGuard
{
public:
    /// Follows symbolic links first. Fails with PortNotFound, PortForbidden, PortBusy, PortUnsuitable; `name` is for
    /// the messages.
    static Result<PortGuard> take(const QString &name);

    PortGuard(PortGuard &&other) noexcept;
    PortGuard &operator=(PortGuard &&) = delete;
    ~PortGuard();

    const QString &path() const { return m_path; } ///< with links resolved: "/dev/ttyUSB0"

private:
    PortGuard(int descriptor, QString path) : m_descriptor(descriptor), m_path(std::move(path)) { }

    int m_descriptor;
    QString m_path;
};

/// Who has the port open, as far as the system tells: "screen (process 4711)", "this program". Empty: unknown.
QString holderOf(const QString &path);

enum class Wait { Readable, TimedOut, Lost };
/// Waits for input at most that long, to a fraction of a millisecond.
Wait waitReadable(int descriptor, LineTime duration);

bool isPseudoTerminal(const QString &path);
/// How long the adapter holds back what it received, as far as the system tells.
std::optional<LineTime> latencyTimer(const QString &path);
/// Sets that to one millisecond where this user may, as the udev rule lets those who sit at the machine.
bool lowerLatencyTimer(const QString &path);
/// Asks the driver to hand over bytes as they come. Adapters may refuse it.
bool setLowLatency(int descriptor);
/// The rate that the driver really made of what it was asked for.
std::optional<int> actualBaudRate(int descriptor);

} // namespace dynascope::posix
