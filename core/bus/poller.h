// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

#include <map>

namespace dynascope {

/// Runs a PollPlan cycle by cycle. Bus thread; no timer of its own: whoever owns it asks when the next cycle is due.
///
/// A silent device goes last in its group, then to a slow probe with back-off, and returns by itself; a device that
/// does not know fast reads falls back to Sync Read for as long as its traits stay.
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
    struct DeviceState {
        int silent = 0;       ///< cycles without an answer in a row
        LineTime probeAt{};   ///< while silent: when to ask again
        LineTime backOff{};   ///< until the probe after that
        int fastFailures = 0; ///< fast reads that failed where a plain one brought the value
    };
    struct Cycle;

    bool isSleeping(std::uint8_t id) const;
    Result<void> probe(std::uint8_t id);
    Result<void> collectDue(Cycle &cycle);
    Result<void> readPass(Cycle &cycle, bool lastPass);
    Result<void> runExchange(
        Cycle &cycle, const PlannedExchange &planned, std::vector<std::size_t> &again, bool lastPass);
    void answered(std::uint8_t id, bool afterFastFailure);
    void missed(std::uint8_t id);
    void schedule(Cycle &cycle);
    std::vector<Traits> currentTraits(const Cycle &cycle) const;

    Bus &m_bus;
    PollPlan m_plan;
    std::vector<LineTime> m_due; ///< per span of the plan
    std::map<std::uint8_t, DeviceState> m_devices;
    quint64 m_cycle = 0;
};

} // namespace dynascope
