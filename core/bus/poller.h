// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"
#include "core/bus/pollmeasure.h"
#include "core/bus/pollschedule.h"

#include <array>
#include <bitset>

namespace dynascope {

/// Runs a PollPlan cycle by cycle. Bus thread; no timer of its own: whoever owns it asks when the next cycle is due.
///
/// A silent device goes last in its group, then to a slow probe with back-off, and returns by itself; one that answers
/// Ping and no Read stays there, and so from the start does one told to by its Status Return Level. Of fast, sync and
/// single reads each device gets the fastest that it answers; what was learned of that ends with its firmware.
class Poller
{
public:
    explicit Poller(Bus &bus) : m_bus(bus) { }

    void setPlan(PollPlan plan);
    /// Nothing to read, or not at the line's present rate: whoever has these IDs there is not whom the plan means.
    bool isIdle() const
    {
        const bool elsewhere = m_plan.baudRate != AnyRate && m_plan.baudRate != m_bus.line().baudRate();
        return m_plan.spans.empty() || elsewhere;
    }

    /// When something is due next; `now` or before: at once.
    LineTime nextDue() const;
    /// Reads what is due. Error only where the line itself failed or STOP was pressed. A batch that is handed in again
    /// lends its memory: a cycle like the one before allocates nothing.
    Result<void> runCycle(Batch &batch);
    Result<Batch> runCycle();

    /// What adapter and host add, as measured so far.
    const LineDelays &delays() const { return m_measure.delays(); }
    PollReport report() const { return {delays(), m_taken}; }

private:
    using Indices = std::vector<std::size_t>; ///< of spans of the plan
    static constexpr int SilentCycles = 3;    ///< as often missed, a device is asked rarely
    static constexpr int Failures = 2;        ///< as often, and it doesn't know this kind of read

    struct DeviceState {
        int silent = 0;          ///< cycles without an answer in a row
        int broken = 0;          ///< answered last so badly that the chain broke
        LineTime probeAt{};      ///< while silent: when to ask again
        LineTime backOff{};      ///< until the probe after that
        bool answersPing = false; ///< that is all it does, as far as is known
        bool answersRead = false; ///< whatever its Status Return Level was: somebody set it back
        bool fastProven = false;  ///< has answered a fast read
        bool groupProven = false; ///< has answered a group read
        int fastFailures = 0;     ///< fast reads that failed where a plain one brought the value
        int groupFailures = 0;    ///< group reads that failed where a single one did
    };
    /// A request made ready, and the spans it answers, in reply order.
    struct Step {
        Request request;
        Bytes packet;
        Indices spans, replies; ///< of each span the reply that holds it
        std::vector<std::uint16_t> begins; ///< of each reply: its first address
        LineTime cost{};        ///< by the wire and what is known of the adapter
    };
    enum class Fate { Given, Again, Last }; ///< of what a reply should have brought, in this cycle
    struct Prepared {
        Indices open;
        std::vector<Step> steps;
    };

    bool isMute(std::uint8_t id) const;
    bool isSleeping(std::uint8_t id) const;
    Error silenceOf(std::uint8_t id) const;
    DeviceState &stateOf(std::size_t span) { return m_devices[m_plan.spans[span].span.id]; }
    Result<void> probe(std::uint8_t id);
    void askRest(std::uint8_t id, std::size_t looked);
    Result<void> collectDue(Batch &batch);
    const std::vector<Step> &stepsFor(const Indices &open);
    std::vector<Step> planSteps(const Indices &open) const;
    Result<void> readPass(Batch &batch, int pass);
    Result<void> runStep(Batch &batch, const Step &step, int pass);
    void takeReply(Batch &batch, const Step &step, std::size_t at);
    Fate takeFailure(const Step &step, std::size_t place, int pass);
    bool isRefusedJoin(const Step &step, std::size_t place) const;
    void answered(std::uint8_t id, const Step &step);
    void learnRefusal(int &failures);
    void forgetRefusals();
    void missed(std::uint8_t id);
    void countAnew();
    void measure(const Batch &batch);
    void takeCosts();
    std::vector<Traits> currentTraits() const;

    Bus &m_bus;
    PollPlan m_plan;
    PollSchedule m_schedule;
    PollMeasure m_measure;
    std::vector<PollReport::Taken> m_taken;
    std::vector<std::size_t> m_takenOf; ///< per span of the plan: which of them counts it
    ReadCosts m_costs; ///< for which everything is planned
    std::vector<std::size_t> m_place;            ///< per span of the plan: its value in the batch
    std::array<DeviceState, 256> m_devices;      ///< by ID
    std::vector<Prepared> m_prepared;            ///< of cycles as they were before
    quint64 m_cycle = 0;
    LineTime m_forgetAt = LineTime::max(); ///< when to try again what was refused
    quint64 m_learned = 0; ///< how often a device turned out not to know a kind of read

    // Of the cycle that runs.
    Indices m_dueNow, m_open, m_again, m_last;
    std::bitset<256> m_fastMissed;  ///< did not answer a fast read in this cycle
    std::bitset<256> m_groupMissed; ///< nor a plain group read
    std::bitset<256> m_looked;      ///< were silent, answered a Ping: one Read shows whether they are back
    ExchangeResult m_result;
    LineTime m_lastEnd{}, m_exchanging{}; ///< of the cycle before; so long exchanges took
    std::vector<Step> m_unusual; ///< steps that are not worth keeping
};

} // namespace dynascope
