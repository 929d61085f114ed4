// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QStringView>

namespace dynascope {

/// Where a serial server listens: "tcp://host:port" (raw bytes, the rate is the server's) or "rfc2217://host:port"
/// (sets the rate). A host is a name, an IPv4 address, or an IPv6 address in brackets. "tcp://host:port?baud=N" says
/// which rate the server works at, where that isn't the line's.
struct NetworkAddress {
    enum class Kind { Raw, Rfc2217 };

    Kind kind = Kind::Raw;
    QString host; ///< without brackets
    quint16 port = 0;
    int serverBaud = 0; ///< 0: not said

    /// Does `name` claim to be one, right or wrong?
    static bool isNetworkName(QStringView name);
    /// Fails with PortUnsuitable and what is wrong with it.
    static Result<NetworkAddress> parse(const QString &name);

    friend bool operator==(const NetworkAddress &, const NetworkAddress &) = default;
};

/// Lines of this name take the rate as it is: no other can be tried.
bool isRateTheServers(QStringView name);

} // namespace dynascope
