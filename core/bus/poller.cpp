// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/poller.h"

#include "core/bus/asking.h"
#include "core/bus/messages.h"
#include "core/bus/pollprediction.h"

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr int Passes = 4;            ///< of one cycle, while a broken chain hides devices
constexpr LineTime FirstBackOff = 100ms;
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
        const LineTime due = isSleeping(id) ? std::max(m_schedule.due(i), m_devices[id].probeAt) : m_schedule.due(i);
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
    for (const std::size_t span : m_dueNow)
        m_schedule.taken(span, m_bus.line().now());
    batch.end = m_bus.line().now();
    measure(batch);
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
    m_schedule.choose(now, [&](std::size_t i) {
        const std::uint8_t id = m_plan.spans[i].span.id;
        return !isSleeping(id) || m_devices[id].probeAt <= now;
    });
    for (std::size_t i = 0; i < m_plan.spans.size(); ++i) {
        const std::uint8_t id = m_plan.spans[i].span.id;
        if (m_schedule.due(i) > now || !m_schedule.isChosen(i))
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
    const LineTime begin = m_bus.line().now();
    const Result<ExchangeResult> ping = m_bus.exchange(pingRequest(id), 0);
    if (!ping)
        return tl::unexpected(ping.error());
    const LineTime took = m_bus.line().now() - begin;
    m_exchanging += took;
    m_measure.addProbe(took);
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
    const bool isLook = step.request.replies.size() == 1 && m_looked.test(first);
    const Asking asking(m_bus, isLook);
    const LineTime begin = m_bus.line().now();
    if (Result<void> done = m_bus.exchangeInto(step.request, step.packet, m_result); !done)
        return done;
    const LineTime took = m_bus.line().now() - begin;
    m_exchanging += took;
    if (std::ranges::all_of(m_result.replies, &Result<Reply>::has_value) && !isLook)
        m_measure.addExchange(took, step.cost);
    Fate fate = Fate::Given;
    for (std::size_t at = 0; at < step.spans.size(); ++at) {
        const std::size_t span = step.spans[at], place = step.replies[at];
        const bool isFirst = at == 0 || step.replies[at - 1] != place;
        const std::uint8_t id = m_plan.spans[span].span.id;
        if (m_result.replies[place]) {
            takeReply(batch, step, at);
            if (isFirst)
                answered(id, step);
            if (isLook)
                askRest(id, span);
            continue;
        }
        PollValue &value = batch.values[m_place[span]];
        value.error = m_result.replies[place].error();
        value.at = m_bus.line().now();
        if (isFirst)
            fate = takeFailure(step, place, pass);
        if (fate != Fate::Given)
            (fate == Fate::Again ? m_again : m_last).push_back(span);
        if (isLook && isSilence(value.error))
            value.error = silenceOf(id);
    }
    return {};
}

/// One span's part of a reply.
void Poller::takeReply(Batch &batch, const Step &step, std::size_t at)
{
    const std::size_t place = step.replies[at];
    const Span &span = m_plan.spans[step.spans[at]].span;
    PollValue &value = batch.values[m_place[step.spans[at]]];
    Reply &reply = *m_result.replies[place];
    if (reply.data.size() == span.length) {
        value.data.assign(reply.data.begin(), reply.data.end());
    } else {
        const int from = span.address - step.begins[place];
        value.data.assign(reply.data.begin() + from, reply.data.begin() + from + span.length);
    }
    ++m_taken[m_takenOf[step.spans[at]]].answers;
    value.error = {};
    value.alert = reply.alert;
    value.at = reply.at;
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
Poller::Fate Poller::takeFailure(const Step &step, std::size_t place, int pass)
{
    const std::uint8_t id = step.request.replies[place].id;
    const bool lastPass = pass == Passes;
    if (m_result.isHidden(place))
        return lastPass ? Fate::Given : Fate::Again;
    const ErrorKind kind = m_result.replies[place].error().kind;
    if (kind == ErrorKind::Refused && isRefusedJoin(step, place)) {
        m_costs.unjoined.set(id);
        ++m_learned;
        return lastPass ? Fate::Given : Fate::Again;
    }
    if (!isSilence(m_result.replies[place].error())) {
        if (static_cast<int>(place) == m_result.brokenAt) // heard so badly that the others didn't: last next time
            m_devices[id].broken = 1;
        return Fate::Given;
    }
    const bool fast = step.request.shape == ReplyShape::Fast;
    const DeviceState &state = m_devices[id];
    std::bitset<256> &missedNow = fast ? m_fastMissed : m_groupMissed;
    const bool proven = fast ? state.fastProven : state.groupProven;
    if (isGroup(step.request) && kind != ErrorKind::NotSent && !proven && !lastPass && !missedNow.test(id)) {
        missedNow.set(id);
        return Fate::Last;
    }
    missed(id);
    return Fate::Given;
}

/// More was read than a span: perhaps there is something between them that can't be.
bool Poller::isRefusedJoin(const Step &step, std::size_t place) const
{
    return std::ranges::count(step.replies, place) > 1 && !m_costs.unjoined.test(step.request.replies[place].id);
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
    state.backOff = std::clamp(2 * state.backOff, FirstBackOff, LongestProbeInterval);
    state.probeAt = m_bus.line().now() + state.backOff;
}

} // namespace dynascope
