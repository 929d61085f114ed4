// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"

#include "core/bus/asking.h"
#include "core/bus/messages.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr int SilentCycles = 3;      ///< as often missed, a device is asked rarely
constexpr int Failures = 2;          ///< as often, and it doesn't know this kind of read
constexpr int Passes = 4;            ///< of one cycle, while a broken chain hides devices
constexpr std::size_t Cycles = 16;   ///< kept ready: spans of a few intervals make as many kinds of cycles
constexpr LineTime FirstBackOff = 100ms;
constexpr LineTime LongestBackOff = 3s;
constexpr LineTime Remembered = 1min; ///< that a device doesn't know a kind of read: it may have been the line

bool isSilence(const Error &error)
{
    return error.kind == ErrorKind::NothingReceived || error.kind == ErrorKind::NoHeader
        || error.kind == ErrorKind::NotSent || error.kind == ErrorKind::CutOff || error.kind == ErrorKind::WrongId;
}

bool isGroup(const Request &request)
{
    return request.shape == ReplyShape::InOrder || request.shape == ReplyShape::Fast;
}

} // namespace

void Poller::setPlan(PollPlan plan)
{
    const LineTime now = m_bus.line().now();
    std::vector<LineTime> due;
    for (const PollSpan &span : plan.spans) { // what stays keeps its rhythm
        const auto old = std::ranges::find(m_plan.spans, span);
        due.push_back(old == m_plan.spans.end() ? now : m_due[static_cast<std::size_t>(old - m_plan.spans.begin())]);
    }
    for (std::size_t id = 0; id < m_devices.size(); ++id) {
        const auto before = std::ranges::find(m_plan.traits, id, &Traits::id);
        const auto after = std::ranges::find(plan.traits, id, &Traits::id);
        if (before == m_plan.traits.end() || after == plan.traits.end() || *before != *after)
            m_devices[id] = {};
    }
    m_plan = std::move(plan);
    for (const Traits &device : m_plan.traits) {
        DeviceState &state = m_devices[device.id];
        if (!isMute(device.id) || state.silent > 0)
            continue;
        state.silent = SilentCycles;
        state.answersPing = true; // it was found
        state.backOff = LongestBackOff;
        state.probeAt = now;
    }
    m_due = std::move(due);
    m_place.assign(m_plan.spans.size(), 0);
    m_prepared.clear();
    std::vector<Traits> known = m_plan.traits;
    known.insert(known.end(), m_plan.others.begin(), m_plan.others.end());
    m_bus.setTraits(known);
}

/// Told to answer no Read, and keeping to it. Somebody else may set its Status Return Level back: then it isn't.
bool Poller::isMute(std::uint8_t id) const
{
    const auto traits = std::ranges::find(m_plan.traits, id, &Traits::id);
    return traits != m_plan.traits.end() && traits->statusReturnLevel < 1 && !m_devices[id].answersRead;
}

bool Poller::isSleeping(std::uint8_t id) const
{
    return m_devices[id].silent >= SilentCycles;
}

Error Poller::silenceOf(std::uint8_t id) const
{
    if (!m_devices[id].answersPing)
        return messages::asleep(id);
    return isMute(id) ? messages::silentByLevel(id, 0) : messages::answersOnlyPing(id);
}

LineTime Poller::nextDue() const
{
    LineTime next = LineTime::max();
    for (std::size_t i = 0; i < m_plan.spans.size(); ++i) {
        const std::uint8_t id = m_plan.spans[i].span.id;
        const LineTime due = isSleeping(id) ? std::max(m_due[i], m_devices[id].probeAt) : m_due[i];
        next = std::min(next, due);
    }
    return next;
}

Result<Batch> Poller::runCycle()
{
    Batch batch;
    if (Result<void> done = runCycle(batch); !done)
        return tl::unexpected(done.error());
    return batch;
}

Result<void> Poller::runCycle(Batch &batch)
{
    batch.cycle = ++m_cycle;
    batch.baudRate = m_bus.line().baudRate();
    batch.begin = m_bus.line().now();
    batch.fullRate = false;
    m_fastMissed.reset();
    m_groupMissed.reset();
    m_looked.reset();
    if (batch.begin >= m_forgetAt)
        forgetRefusals();
    if (Result<void> collected = collectDue(batch); !collected)
        return collected;
    for (int pass = 1; pass <= Passes && !m_open.empty(); ++pass) {
        if (Result<void> read = readPass(batch, pass); !read)
            return read;
    }
    schedule();
    batch.end = m_bus.line().now();
    return {};
}

/// Those due; of the sleeping devices those that a Ping finds awake. Who was silent last time goes to the end of its
/// group, where it breaks no chain.
Result<void> Poller::collectDue(Batch &batch)
{
    const LineTime now = m_bus.line().now();
    int probed = -1;
    m_dueNow.clear();
    m_open.clear();
    for (std::size_t i = 0; i < m_plan.spans.size(); ++i) {
        const std::uint8_t id = m_plan.spans[i].span.id;
        if (m_due[i] > now)
            continue;
        if (isSleeping(id) && probed != id) { // one a cycle: the others shall not wait for many
            if (m_devices[id].probeAt > now || probed >= 0)
                continue;
            probed = id;
            if (Result<void> asked = probe(id); !asked)
                return asked;
        }
        m_dueNow.push_back(i);
        batch.fullRate = batch.fullRate || m_plan.spans[i].interval == 0ms;
        const auto isOfIt = [&](std::size_t other) { return m_plan.spans[other].span.id == id; };
        const bool waits = m_looked.test(id) && std::ranges::any_of(m_open, isOfIt); // one Read is enough for a look
        if (!isSleeping(id) && !waits)
            m_open.push_back(i);
    }
    batch.values.resize(m_dueNow.size());
    for (std::size_t place = 0; place < m_dueNow.size(); ++place) {
        const PollSpan &span = m_plan.spans[m_dueNow[place]];
        m_place[m_dueNow[place]] = place;
        PollValue &value = batch.values[place];
        value.device = span.device;
        value.address = span.span.address;
        value.length = span.span.length;
        value.alert = false;
        value.at = now;
        value.data.clear();
        value.answersPing = m_devices[span.span.id].answersPing;
        if (isSleeping(span.span.id) || m_looked.test(span.span.id))
            value.error = silenceOf(span.span.id);
    }
    const auto trouble = [this](std::size_t i) { return stateOf(i).silent + stateOf(i).broken; };
    if (std::ranges::any_of(m_open, [&](std::size_t i) { return trouble(i) > 0; }))
        std::ranges::stable_sort(m_open, {}, trouble);
    return {};
}

/// Who answers may still answer no Read: the next miss lets it sleep on, twice as long as before.
Result<void> Poller::probe(std::uint8_t id)
{
    const Asking asking(m_bus);
    const Result<ExchangeResult> ping = m_bus.exchange(pingRequest(id), 0);
    if (!ping)
        return tl::unexpected(ping.error());
    DeviceState &state = m_devices[id];
    state.answersPing = ping->replies.front().has_value();
    if (state.answersPing) {
        state.silent = SilentCycles - 1;
        m_looked.set(id);
    } else {
        missed(id);
    }
    return {};
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
    std::vector<PollSpan> spans;
    for (const std::size_t index : open)
        spans.push_back(m_plan.spans[index]);
    std::vector<Step> steps;
    for (PlannedExchange &planned : planExchanges(spans, currentTraits())) {
        Step step{std::move(planned.request), {}, {}};
        step.packet = encode(step.request.packet);
        for (const std::size_t index : planned.indices)
            step.spans.push_back(open[index]);
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

Result<void> Poller::readPass(Batch &batch, int pass)
{
    m_again.clear();
    m_last.clear();
    const quint64 learned = m_learned;
    const std::vector<Step> &steps = stepsFor(m_open);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (Result<void> done = runStep(batch, steps[i], pass); !done)
            return done;
    }
    if (learned != m_learned)
        m_prepared.clear(); // made for devices as they were thought to be
    m_again.insert(m_again.end(), m_last.begin(), m_last.end());
    m_open.swap(m_again);
    return {};
}

Result<void> Poller::runStep(Batch &batch, const Step &step, int pass)
{
    const std::uint8_t first = m_plan.spans[step.spans.front()].span.id;
    const bool isLook = step.spans.size() == 1 && m_looked.test(first);
    const Asking asking(m_bus, isLook);
    if (Result<void> done = m_bus.exchangeInto(step.request, step.packet, m_result); !done)
        return done;
    for (std::size_t place = 0; place < step.spans.size(); ++place) {
        const std::size_t span = step.spans[place];
        Result<Reply> &reply = m_result.replies[place];
        PollValue &value = batch.values[m_place[span]];
        if (!reply) {
            value.error = reply.error();
            value.at = m_bus.line().now();
            takeFailure(step, place, pass);
            if (isLook && isSilence(value.error))
                value.error = silenceOf(m_plan.spans[span].span.id);
            continue;
        }
        value.data.swap(reply->data);
        value.error = {};
        value.alert = reply->alert;
        value.at = reply->at;
        answered(m_plan.spans[span].span.id, step);
        if (isLook)
            askRest(m_plan.spans[span].span.id, span);
    }
    return {};
}

/// It is back: whatever else of it is due is read, too.
void Poller::askRest(std::uint8_t id, std::size_t looked)
{
    m_looked.reset(id);
    for (const std::size_t span : m_dueNow) {
        if (span != looked && m_plan.spans[span].span.id == id)
            m_again.push_back(span);
    }
}

/// Hidden by another one's silence: again. Silent itself: again with a plainer read, if it may be that it doesn't know
/// this one. Else it is missing.
void Poller::takeFailure(const Step &step, std::size_t place, int pass)
{
    const std::size_t span = step.spans[place];
    const std::uint8_t id = m_plan.spans[span].span.id;
    const bool lastPass = pass == Passes;
    if (m_result.isHidden(place)) {
        if (!lastPass)
            m_again.push_back(span);
        return;
    }
    const ErrorKind kind = m_result.replies[place].error().kind;
    if (!isSilence(m_result.replies[place].error())) {
        if (static_cast<int>(place) == m_result.brokenAt) // heard so badly that the others didn't: last next time
            m_devices[id].broken = 1;
        return;
    }
    const bool fast = step.request.shape == ReplyShape::Fast;
    const DeviceState &state = m_devices[id];
    std::bitset<256> &missedNow = fast ? m_fastMissed : m_groupMissed;
    const bool proven = fast ? state.fastProven : state.groupProven;
    if (isGroup(step.request) && kind != ErrorKind::NotSent && !proven && !lastPass && !missedNow.test(id)) {
        missedNow.set(id);
        m_last.push_back(span);
    } else {
        missed(id);
    }
}

void Poller::answered(std::uint8_t id, const Step &step)
{
    DeviceState &state = m_devices[id];
    state.silent = 0;
    state.broken = 0;
    state.backOff = {};
    state.answersPing = false;
    state.answersRead = true;
    state.fastProven = state.fastProven || step.request.shape == ReplyShape::Fast;
    state.groupProven = state.groupProven || isGroup(step.request);
    if (m_groupMissed.test(id) && !isGroup(step.request))
        learnRefusal(state.groupFailures);
    else if (m_fastMissed.test(id) && step.request.shape != ReplyShape::Fast)
        learnRefusal(state.fastFailures);
}

void Poller::learnRefusal(int &failures)
{
    if (++failures < Failures)
        return;
    ++m_learned;
    m_forgetAt = std::min(m_forgetAt, m_bus.line().now() + Remembered);
}

void Poller::forgetRefusals()
{
    for (DeviceState &state : m_devices)
        state.fastFailures = state.groupFailures = 0;
    m_prepared.clear();
    m_forgetAt = LineTime::max();
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

void Poller::schedule()
{
    const LineTime now = m_bus.line().now();
    for (const std::size_t index : m_dueNow) {
        const LineTime interval = m_plan.spans[index].interval;
        m_due[index] += interval;
        if (m_due[index] < now) // what was missed is not made up for
            m_due[index] = interval == 0ms ? now : now + interval;
    }
}

} // namespace dynascope
