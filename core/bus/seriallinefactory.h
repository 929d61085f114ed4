// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/linefactory.h"

#include <chrono>
#include <optional>

namespace dynascope {

struct SerialOptions {
    /// How late an answer may come on account of the host. Default by kind: a pseudo-terminal 50 ms; else what the
    /// adapter holds bytes back, 16 ms where that isn't known, and 5 ms of scheduling.
    std::optional<LineTime> hostAllowance;
};

/// Opens serial ports by their path.
class SerialLineFactory final : public LineFactory
{
public:
    explicit SerialLineFactory(SerialOptions options = {}) : m_options(options) {}

    bool knows(const QString &name) const override;
    Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) override;

private:
    const SerialOptions m_options;
};

/// The machine's serial ports, likely adapters first. Cheap enough to be asked once a second: the system's list, which
/// takes it 15 ms, is made anew only after something has changed.
class SerialPortList final : public PortList
{
public:
    std::vector<PortInfo> ports() const override;

private:
    mutable QStringList m_traces; ///< what there was at the last look
    mutable std::vector<PortInfo> m_ports;
    mutable std::chrono::steady_clock::time_point m_settledAt;
    mutable bool m_isSettled = false; ///< the list was made after everything had settled
};

} // namespace dynascope
