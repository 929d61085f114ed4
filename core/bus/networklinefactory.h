// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"

#include <optional>

namespace dynascope {

struct NetworkOptions {
    LineTime connectLimit = std::chrono::seconds(5); ///< looking the host up included
    /// How late an answer may come on account of server and network. Default: what a server's adapter and its gathering
    /// of bytes cost, and the network's round trip as seen when connecting.
    std::optional<LineTime> hostAllowance;
};

/// Opens "tcp://host:port" and "rfc2217://host:port": serial ports that a server on the network passes on.
class NetworkLineFactory final : public LineFactory
{
public:
    explicit NetworkLineFactory(NetworkOptions options = {}) : m_options(options) { }

    bool knows(const QString &name) const override;
    Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) override;
    Result<std::unique_ptr<Line>> openUnless(const std::atomic<bool> &cancel, const QString &name,
                                             int baudRate) override;

private:
    const NetworkOptions m_options;
};

} // namespace dynascope
