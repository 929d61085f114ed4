// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

#include <map>

namespace dynascope {

/// Runs a PollPlan cycle by cycle. Bus thread; no timer of its own: whoever owns it asks when the next cycle is due.
///
/// A silent device goes last in its group, then to a slow probe with back-off, and returns by itself; a device that does
/// not know fast reads falls back to Sync Read for as long as its traits stay.
class Poller
{
public:
    explicit Poller(Bus &bus);

    void setPlan(PollPlan plan);
    bool isIdle() const { return m_plan.spans.empty(); }

    /// When something is due next; `now` or before: at once.
    LineTime nextDue() const;
    /// Reads what is due. Error only where the line itself failed or STOP was pressed.
    Result<Batch> runCycle();

private:
    struct SpanState {
        LineTime due{};
    };
    struct DeviceState {
        int silent = 0;       ///< cycles without an answer in a row
        LineTime probeAt{};   ///< while silent: when to ask again
        bool fastRefused = false;
    };
    Bus &m_bus;
    PollPlan m_plan;
    std::vector<SpanState> m_spans;
    std::map<std::uint8_t, DeviceState> m_devices;
    quint64 m_cycle = 0;
};

} // namespace dynascope
