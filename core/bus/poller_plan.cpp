// SPDX-License-Identifier: GPL-3.0-or-later
// Of Poller: the plan, what it costs on this line, and the requests made of it.
#include "core/bus/poller.h"

#include "core/bus/pollprediction.h"

#include <algorithm>
#include <map>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t Cycles = 64; ///< kept ready: each turn makes another kind of cycle

} // namespace

void Poller::setPlan(PollPlan plan)
{
    const LineTime now = m_bus.line().now();
    for (std::size_t id = 0; id < m_devices.size(); ++id) {
        const auto before = std::ranges::find(m_plan.traits, id, &Traits::id);
        const auto after = std::ranges::find(plan.traits, id, &Traits::id);
        if (before == m_plan.traits.end() || after == plan.traits.end() || *before != *after) {
            m_devices[id] = {};
            m_costs.unjoined.reset(id);
        }
    }
    m_plan = std::move(plan);
    m_schedule.setPlan(m_plan.spans, now);
    for (const Traits &device : m_plan.traits) {
        DeviceState &state = m_devices[device.id];
        if (!isMute(device.id) || state.silent > 0)
            continue;
        state.silent = SilentCycles;
        state.answersPing = true; // it was found
        state.backOff = LongestProbeInterval;
        state.probeAt = now;
    }
    m_place.assign(m_plan.spans.size(), 0);
    countAnew();
    takeCosts();
    std::vector<Traits> known = m_plan.traits;
    known.insert(known.end(), m_plan.others.begin(), m_plan.others.end());
    m_bus.setTraits(known);
}

void Poller::countAnew()
{
    std::map<std::chrono::milliseconds, std::size_t> places;
    for (const PollSpan &span : m_plan.spans)
        places.try_emplace(span.interval);
    m_taken.clear();
    for (auto &[interval, place] : places) {
        place = m_taken.size();
        m_taken.push_back({interval, 0});
    }
    m_takenOf.clear();
    for (const PollSpan &span : m_plan.spans)
        m_takenOf.push_back(places[span.interval]);
}

/// What is no exchange between two cycles that follow each other counts as the host's.
void Poller::measure(const Batch &batch)
{
    if (batch.fullRate && m_lastEnd > LineTime())
        m_measure.addCycle(batch.end - m_lastEnd - m_exchanging);
    m_lastEnd = batch.fullRate ? batch.end : LineTime();
    m_exchanging = {};
    if (!m_measure.update(batch.end))
        return;
    const LineTime used = m_costs.delays.perExchange;
    const LineTime off = std::chrono::abs(std::max(LineTime(), m_measure.delays().perExchange) - used);
    if (off > 50us && off > used / 4)
        takeCosts();
}

/// What reads cost decides which are sent.
void Poller::takeCosts()
{
    const Line &line = m_bus.line();
    LineDelays known;
    known.latencyTimer = line.latencyTimer().value_or(LineTime());
    if (line.byteTime() != m_costs.byteTime || known.latencyTimer != m_measure.delays().latencyTimer)
        m_measure.reset(known);
    m_costs.byteTime = line.byteTime();
    m_costs.delays = m_measure.delays();
    m_costs.delays.perExchange = std::max(LineTime(), m_costs.delays.perExchange);
    m_costs.mayJoin = true;
    m_schedule.setTurns(turnsOf(m_plan, m_costs));
    m_prepared.clear();
}

std::vector<Traits> Poller::currentTraits() const
{
    std::vector<Traits> traits = m_plan.traits;
    for (Traits &device : traits) {
        const DeviceState &state = m_devices[device.id];
        const bool single = m_looked.test(device.id);
        device.fastReads =
            device.fastReads && state.fastFailures < Failures && !m_fastMissed.test(device.id) && !single;
        device.groupReads =
            device.groupReads && state.groupFailures < Failures && !m_groupMissed.test(device.id) && !single;
        if (state.answersRead)
            device.statusReturnLevel = std::max<std::uint8_t>(device.statusReturnLevel, 1);
    }
    return traits;
}

std::vector<Poller::Step> Poller::planSteps(const Indices &open) const
{
    const std::vector<Traits> traits = currentTraits();
    ReadCosts wire = m_costs;
    wire.delays.perExchange = {};
    std::vector<Step> steps;
    for (PlannedExchange &planned : planCycle(m_plan, open, traits, m_costs)) {
        Step step{std::move(planned.request), {}, std::move(planned.indices), std::move(planned.replies),
                  std::move(planned.begins), {}};
        step.packet = encode(step.request.packet);
        step.cost = costOf(step.request, traits, wire.byteTime, wire.delays).total();
        steps.push_back(std::move(step));
    }
    return steps;
}

/// Cycles repeat: what they send is made once.
const std::vector<Poller::Step> &Poller::stepsFor(const Indices &open)
{
    if (m_fastMissed.any() || m_groupMissed.any() || m_looked.any()) {
        m_unusual = planSteps(open);
        return m_unusual;
    }
    const auto known = std::ranges::find(m_prepared, open, &Prepared::open);
    if (known != m_prepared.end())
        return known->steps;
    if (m_prepared.size() >= Cycles)
        m_prepared.erase(m_prepared.begin());
    m_prepared.push_back({open, planSteps(open)});
    return m_prepared.back().steps;
}

} // namespace dynascope
