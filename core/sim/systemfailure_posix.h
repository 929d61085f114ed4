// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <cerrno>
#include <cstring>

namespace dynascope::sim {

/// What the system has just refused, with errno in its own words: "what: Permission denied".
inline tl::unexpected<Error> systemFailure(const QString &what)
{
    return failure(ErrorKind::PortUnsuitable,
                   QStringLiteral("%1: %2").arg(what, QString::fromLocal8Bit(std::strerror(errno))));
}

} // namespace dynascope::sim
