// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace dynascope {

/// What the system's files tell about the USB adapter behind a serial port.
struct UsbIdentity {
    QString identity; ///< as PortInfo::identity
    QString plug;     ///< changes whenever something is plugged in there, be it the same adapter
};

/// Empty where it is no USB adapter, or the system has no such files. `ports` is Linux's folder of them.
UsbIdentity usbIdentity(const QString &portName, const QString &ports = QStringLiteral("/sys/class/tty"));

} // namespace dynascope
