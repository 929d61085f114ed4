// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"

#include "core/bus/messagetext.h"

#include <QFileInfo>

namespace dynascope::messages {

Error noLatencyTimer(const QString &line)
{
    return {ErrorKind::PortUnsuitable,
            Messages::tr("%1 has no latency timer that could be set: what is waited for is the "
                         "adapter's own pace, or this computer's")
                .arg(line)};
}

Error latencyRefused(const QString &line, const QString &path, std::chrono::nanoseconds timer)
{
    const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(timer).count();
    return {ErrorKind::PortUnsuitable,
            Messages::tr("%1 keeps its latency timer of %2 ms: this user may not set it. As root: echo 1 > "
                         "/sys/bus/usb-serial/devices/%3/latency_timer; for good, install the udev rule "
                         "70-dynascope.rules and plug the adapter in again")
                .arg(line).arg(milliseconds).arg(QFileInfo(path).fileName())};
}

} // namespace dynascope::messages
