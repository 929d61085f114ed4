// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"

#include <algorithm>
#include <set>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr int SilentCycles = 3; ///< as often missed, a device is asked rarely
constexpr int FastFailures = 2; ///< as often, and it doesn't know fast reads
constexpr int Passes = 3;       ///< of one cycle, while a broken chain hides devices
constexpr LineTime FirstBackOff = 100ms;
constexpr LineTime LongestBackOff = 2s;

bool isSilence(const Error &error)
{
    return error.kind == ErrorKind::NothingReceived || error.kind == ErrorKind::NoHeader
        || error.kind == ErrorKind::CutOff || error.kind == ErrorKind::WrongId;
}

} // namespace

/// What is read in one cycle: positions in the plan and what each brought.
struct Poller::Cycle {
    std::vector<std::size_t> due;
    std::vector<std::size_t> open; ///< of these, what has to be asked in the next pass
    std::map<std::size_t, PollValue> values;
    std::set<std::uint8_t> fastMissed; ///< did not answer a fast read in this cycle
};

Poller::Poller(Bus &bus) : m_bus(bus) { }

void Poller::setPlan(PollPlan plan)
{
    const LineTime now = m_bus.line().now();
    std::vector<LineTime> due;
    for (const PollSpan &span : plan.spans) { // what stays keeps its rhythm
        const auto old = std::ranges::find(m_plan.spans, span);
        due.push_back(old == m_plan.spans.end() ? now : m_due[static_cast<std::size_t>(old - m_plan.spans.begin())]);
    }
    for (auto it = m_devices.begin(); it != m_devices.end();) {
        const auto before = std::ranges::find(m_plan.traits, it->first, &Traits::id);
        const auto after = std::ranges::find(plan.traits, it->first, &Traits::id);
        const bool same = before != m_plan.traits.end() && after != plan.traits.end() && *before == *after;
        it = same ? std::next(it) : m_devices.erase(it);
    }
    m_plan = std::move(plan);
    m_due = std::move(due);
    m_bus.setTraits(m_plan.traits);
}

bool Poller::isSleeping(std::uint8_t id) const
{
    const auto state = m_devices.find(id);
    return state != m_devices.end() && state->second.silent >= SilentCycles;
}

LineTime Poller::nextDue() const
{
    LineTime next = LineTime::max();
    for (std::size_t i = 0; i < m_plan.spans.size(); ++i) {
        const std::uint8_t id = m_plan.spans[i].span.id;
        const LineTime due = isSleeping(id) ? std::max(m_due[i], m_devices.at(id).probeAt) : m_due[i];
        next = std::min(next, due);
    }
    return next;
}

Result<Batch> Poller::runCycle()
{
    Batch batch;
    batch.cycle = ++m_cycle;
    batch.begin = m_bus.line().now();
    Cycle cycle;
    if (Result<void> collected = collectDue(cycle); !collected)
        return tl::unexpected(collected.error());
    for (int pass = 1; pass <= Passes && !cycle.open.empty(); ++pass) {
        if (Result<void> read = readPass(cycle, pass == Passes); !read)
            return tl::unexpected(read.error());
    }
    schedule(cycle);
    batch.end = m_bus.line().now();
    for (auto &[index, value] : cycle.values) {
        batch.fullRate = batch.fullRate || m_plan.spans[index].interval == 0ms;
        batch.values.push_back(std::move(value));
    }
    return batch;
}

/// Those due; of the sleeping devices those that a Ping finds awake. Who was silent last time goes to the end of its
/// group, where it breaks no chain.
Result<void> Poller::collectDue(Cycle &cycle)
{
    const LineTime now = m_bus.line().now();
    std::set<std::uint8_t> probed;
    for (std::size_t i = 0; i < m_plan.spans.size(); ++i) {
        const PollSpan &span = m_plan.spans[i];
        if (m_due[i] > now)
            continue;
        if (isSleeping(span.span.id)) {
            if (m_devices[span.span.id].probeAt > now && !probed.contains(span.span.id))
                continue;
            if (probed.insert(span.span.id).second) {
                if (Result<void> asked = probe(span.span.id); !asked)
                    return asked;
            }
        }
        cycle.due.push_back(i);
        PollValue value;
        value.device = span.device;
        value.address = span.span.address;
        value.length = span.span.length;
        value.at = m_bus.line().now();
        if (isSleeping(span.span.id))
            value.error = {ErrorKind::NothingReceived, QStringLiteral("device %1 does not answer").arg(span.span.id)};
        else
            cycle.open.push_back(i);
        cycle.values[i] = value;
    }
    std::ranges::stable_sort(
        cycle.open, {}, [this](std::size_t i) { return m_devices[m_plan.spans[i].span.id].silent; });
    return {};
}

Result<void> Poller::probe(std::uint8_t id)
{
    const Result<ExchangeResult> ping = m_bus.exchange(pingRequest(id), 0);
    if (!ping)
        return tl::unexpected(ping.error());
    DeviceState &state = m_devices[id];
    if (ping->replies.front()) {
        state.silent = 0;
        state.backOff = {};
    } else {
        missed(id);
    }
    return {};
}

std::vector<Traits> Poller::currentTraits(const Cycle &cycle) const
{
    std::vector<Traits> traits = m_plan.traits;
    for (Traits &device : traits) {
        const auto state = m_devices.find(device.id);
        const bool refused = state != m_devices.end() && state->second.fastFailures >= FastFailures;
        device.fastReads = device.fastReads && !refused && !cycle.fastMissed.contains(device.id);
    }
    return traits;
}

Result<void> Poller::readPass(Cycle &cycle, bool lastPass)
{
    std::vector<PollSpan> spans;
    for (const std::size_t index : cycle.open)
        spans.push_back(m_plan.spans[index]);
    std::vector<std::size_t> again;
    for (PlannedExchange planned : planExchanges(spans, currentTraits(cycle))) {
        for (std::size_t &index : planned.indices)
            index = cycle.open[index];
        if (Result<void> done = runExchange(cycle, planned, again, lastPass); !done)
            return done;
    }
    cycle.open = std::move(again);
    return {};
}

Result<void> Poller::runExchange(
    Cycle &cycle, const PlannedExchange &planned, std::vector<std::size_t> &again, bool lastPass)
{
    Result<ExchangeResult> result = m_bus.exchange(planned.request, 0);
    if (!result)
        return tl::unexpected(result.error());
    std::vector<std::size_t> last;
    for (std::size_t i = 0; i < planned.indices.size(); ++i) {
        const std::size_t index = planned.indices[i];
        const std::uint8_t id = m_plan.spans[index].span.id;
        Result<Reply> &reply = result->replies[i];
        PollValue &value = cycle.values[index];
        value.at = m_bus.line().now();
        if (reply) {
            value.data = std::move(reply->data);
            value.error = {};
            value.alert = reply->alert;
            value.at = reply->at;
            answered(id, cycle.fastMissed.contains(id));
            continue;
        }
        value.error = reply.error();
        const bool hidden = result->brokenAt >= 0 && static_cast<int>(i) > result->brokenAt;
        if (hidden) {
            if (!lastPass)
                again.push_back(index);
            continue;
        }
        if (!isSilence(reply.error()))
            continue;
        const bool tryPlain = planned.request.shape == ReplyShape::Fast && !lastPass;
        if (tryPlain && cycle.fastMissed.insert(id).second)
            last.push_back(index); // perhaps it doesn't know fast reads
        else
            missed(id);
    }
    again.insert(again.end(), last.begin(), last.end());
    return {};
}

void Poller::answered(std::uint8_t id, bool afterFastFailure)
{
    DeviceState &state = m_devices[id];
    state.silent = 0;
    state.backOff = {};
    if (afterFastFailure)
        ++state.fastFailures;
}

void Poller::missed(std::uint8_t id)
{
    DeviceState &state = m_devices[id];
    ++state.silent;
    if (state.silent < SilentCycles)
        return;
    state.backOff = std::clamp(2 * state.backOff, FirstBackOff, LongestBackOff);
    state.probeAt = m_bus.line().now() + state.backOff;
}

void Poller::schedule(Cycle &cycle)
{
    const LineTime now = m_bus.line().now();
    for (const std::size_t index : cycle.due) {
        const LineTime interval = m_plan.spans[index].interval;
        m_due[index] += interval;
        if (m_due[index] < now) // what was missed is not made up for
            m_due[index] = interval == 0ms ? now : now + interval;
    }
}

} // namespace dynascope
