// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"

#include "core/sim/adapter.h"
#include "core/sim/baudmismatch.h"
#include "core/sim/groupreply.h"
#include "core/sim/motor.h"
#include "core/sim/power.h"
#include "core/sim/replyspoiler.h"
#include "core/sim/wire.h"

#include <algorithm>

namespace dynascope::sim {

/// A reply that waits for its time.
struct SimulatedBus::Scheduled {
    LineTime at{};
    Servo *servo = nullptr;
    int baudRate = 57600;
    StatusPacket status;
    Bytes bytes;
    bool givesUp = false; ///< dropped when its sender hears another instruction first
    std::shared_ptr<Chain> chain;
    std::size_t index = 0;
};

namespace {

constexpr std::uint64_t SeedStep = 0x9E3779B97F4A7C15ULL; ///< spreads one seed over the servos

LineTime duration(const Reaction &reaction)
{
    Transmission reply;
    reply.baudRate = reaction.baudRate;
    reply.bytes = encode(reaction.status);
    return reply.end();
}

} // namespace

SimulatedBus::SimulatedBus(const Catalog &catalog, std::uint64_t seed)
    : m_catalog(catalog)
    , m_seed(seed)
    , m_power(std::make_unique<Power>())
    , m_wire(std::make_unique<Wire>())
    , m_spoiler(std::make_unique<ReplySpoiler>())
    , m_adapter(std::make_unique<Adapter>())
{
}

SimulatedBus::~SimulatedBus() = default;

void SimulatedBus::beginAt(LineTime now)
{
    m_now = m_controllerFree = now;
    m_power->beginAt(now);
    for (const auto &servo : m_servos)
        servo->beginAt(now);
}

Result<Servo *> SimulatedBus::add(const ServoSpec &wanted)
{
    ServoSpec spec = wanted;
    if (const auto good = checkServoSpec(spec, m_catalog); !good)
        return tl::unexpected(good.error());
    const Catalog::ModelInfo *info = m_catalog.model(QStringView(spec.model));
    const int firmware = spec.firmware < 0 ? info->newestFirmware : spec.firmware;
    const ControlTablePtr table = m_catalog.find(info->modelNumber, firmware);
    const MotorModel *motor = findMotor(info->model);
    if (!motor)
        return failure(ErrorKind::NotSupported, QStringLiteral("The simulator can't play %1").arg(info->model));
    const std::size_t first = m_servos.size();
    for (const int id : {spec.id, spec.secondId}) {
        if (id < 0)
            continue;
        m_seed += SeedStep;
        m_servos.push_back(
            std::make_unique<Servo>(table, *motor, Servo::Identity{firmware, id, spec.baudRate}, m_seed));
        m_servos.back()->beginAt(m_now);
        m_power->connect(*m_servos.back(), m_now);
    }
    Servo *const servo = m_servos[first].get();
    if (spec.secondId >= 0) {
        Servo *const second = m_servos[first + 1].get();
        servo->setOtherAxis(second);
        second->setOtherAxis(servo);
        // Such models ship with the IDs 1 and 2. That a Factory Reset gives each axis its own again isn't documented.
        second->settings().factoryId = static_cast<int>(table->find(Known::Id)->initial.value_or(1)) + 1;
        m_twins.push_back({{servo, second}, spec.baudRate});
    }
    return servo;
}

/// Two axes are one device on the wire: a rate that one was told is the other's too.
void SimulatedBus::shareBaudRates()
{
    for (Twins &twins : m_twins) {
        for (std::size_t i = 0; i < 2; ++i) {
            Servo &told = *twins.axes[i], &other = *twins.axes[1 - i];
            if (told.baudRate() == twins.baudRate)
                continue;
            twins.baudRate = told.baudRate();
            other.write(nameOf(Known::BaudRate), told.table().baudCode(twins.baudRate).value_or(0));
            break;
        }
    }
}

Servo *SimulatedBus::servo(int id, int baudRate) const
{
    for (const auto &servo : m_servos) {
        if (servo->id() == id && servo->baudRate() == baudRate)
            return servo.get();
    }
    return nullptr;
}

void SimulatedBus::setLogging(bool on)
{
    m_logging = on;
}

void SimulatedBus::send(ByteView bytes, LineTime begin, int baudRate)
{
    runTo(begin);
    Transmission sent;
    sent.begin = std::max(begin, m_controllerFree); // a port sends one packet after the other
    sent.baudRate = baudRate;
    sent.bytes.assign(bytes.begin(), bytes.end());
    m_controllerFree = sent.end();
    m_listening = baudRate;
    m_adapter->send(sent);
    if (!sent.bytes.empty())
        m_wire->begin(std::move(sent));
}

void SimulatedBus::receive(Bytes &to, LineTime now, int baudRate)
{
    m_listening = baudRate;
    runTo(now);
    bringToAdapter(now);
    m_adapter->deliver(to, now);
}

std::pair<LineTime, LineTime> SimulatedBus::arrived() const
{
    return m_adapter->delivered();
}

void SimulatedBus::bringToAdapter(LineTime now)
{
    m_heard.clear();
    m_wire->hear(m_heard, now, m_listening);
    m_adapter->take(m_heard);
}

void SimulatedBus::discardArrived(LineTime now)
{
    Bytes forgotten;
    receive(forgotten, now, m_listening);
}

void SimulatedBus::setFaults(LineFaults faults)
{
    m_spoiler->setFaults(faults);
    m_adapter->setFaults(faults, m_now);
    m_wire->setEcho(faults.echo.on);
    m_jitter = Chance(faults.seed ^ SeedStep);
    m_faults = std::move(faults);
}

bool SimulatedBus::isUnplugged() const
{
    return m_adapter->isUnplugged();
}

bool SimulatedBus::isAmong(const std::vector<int> &ids, const Servo &servo) const
{
    return !ids.empty() && std::ranges::find(ids, servo.id()) != ids.end();
}

void SimulatedBus::advanceTo(LineTime now)
{
    runTo(now);
    for (const auto &servo : m_servos)
        servo->advanceTo(now);
}

std::optional<LineTime> SimulatedBus::nextArrival() const
{
    std::optional<LineTime> next = m_wire->nextByte();
    const auto consider = [&next](LineTime at) { next = next ? std::min(*next, at) : at; };
    if (const auto end = m_wire->nextEnd())
        consider(*end);
    for (const Scheduled &reply : m_scheduled)
        consider(reply.at);
    for (const auto &event : {m_adapter->next(), m_adapter->nextNoise()}) {
        if (event)
            consider(*event);
    }
    return next;
}

std::optional<LineTime> SimulatedBus::quietAt() const
{
    const auto wire = m_wire->quiet(), adapter = m_adapter->quiet();
    return wire && adapter ? std::max(*wire, *adapter) : wire ? wire : adapter;
}

void SimulatedBus::runTo(LineTime now)
{
    for (;;) {
        const auto end = m_wire->nextEnd();
        const auto reply = std::ranges::min_element(m_scheduled, {}, &Scheduled::at);
        const bool haveReply = reply != m_scheduled.end();
        const bool endFirst = end && (!haveReply || *end <= reply->at);
        const auto noise = m_adapter->nextNoise();
        if (noise && *noise <= now && (!end || *noise < *end) && (!haveReply || *noise < reply->at)) {
            bringToAdapter(*noise);
            m_adapter->makeNoise(m_wire->busyUntil(*noise));
        } else if (endFirst && *end <= now) {
            const Transmission sent = m_wire->takeEnded();
            if (m_logging)
                m_log.push_back({sent.begin, sent.end(), sent.baudRate, sent.sender == nullptr, sent.bytes});
            sent.sender ? hearServo(sent) : hearController(sent);
        } else if (!endFirst && haveReply && reply->at <= now) {
            Scheduled due = std::move(*reply);
            m_scheduled.erase(reply);
            begin(due);
        } else {
            break;
        }
    }
    m_now = std::max(m_now, now);
}

void SimulatedBus::hearController(const Transmission &sent)
{
    std::vector<std::pair<Servo *, Reaction>> all;
    for (const auto &servo : m_servos) {
        if (isAmong(m_faults.deaf, *servo))
            continue;
        const bool same = understandEachOther(sent.baudRate, servo->baudRate());
        const Bytes heard = same ? sent.bytes : heardAtOtherBaud(sent.bytes, sent.baudRate, servo->baudRate());
        const auto count = static_cast<LineTime::rep>(std::max<std::size_t>(heard.size(), 1));
        const LineTime byteTime = (sent.end() - sent.begin) / count;
        std::vector<Reaction> reactions;
        if (servo->hear(heard, sent.begin, byteTime, reactions))
            interrupt(servo.get());
        for (Reaction &reaction : reactions)
            all.emplace_back(servo.get(), std::move(reaction));
    }
    shareBaudRates();
    plan(std::move(all));
}

/// Who waits for its turn and hears another instruction waits no longer.
void SimulatedBus::interrupt(const Servo *servo)
{
    std::erase_if(m_scheduled, [servo](const Scheduled &reply) { return reply.givesUp && reply.servo == servo; });
    for (const auto &chain : m_chains)
        std::erase_if(chain->waiting, [servo](const Chain::Member &member) { return member.servo == servo; });
    std::erase_if(m_chains, [](const auto &chain) { return chain->waiting.empty(); });
}

void SimulatedBus::plan(std::vector<std::pair<Servo *, Reaction>> reactions)
{
    std::vector<std::pair<Servo *, Reaction>> pings;
    for (auto &[servo, reaction] : reactions) {
        switch (reaction.turn) {
        case Reaction::Turn::Direct: {
            Scheduled reply;
            reply.at = reaction.heardAt + reaction.delay + jitter();
            reply.servo = servo;
            reply.baudRate = reaction.baudRate;
            reply.bytes = encode(reaction.status);
            reply.status = std::move(reaction.status);
            m_scheduled.push_back(std::move(reply));
            break;
        }
        case Reaction::Turn::Slot: pings.emplace_back(servo, std::move(reaction)); break;
        case Reaction::Turn::Chain: joinChain(servo, std::move(reaction)); break;
        }
    }
    planPings(std::move(pings));
    const auto chains = m_chains; // the member changes while they go on
    for (const auto &chain : chains)
        continueChain(chain, 0, chain->heardAt);
}

LineTime SimulatedBus::jitter()
{
    const auto most = static_cast<double>(m_faults.replyJitter.count());
    return most > 0 ? LineTime(static_cast<LineTime::rep>(most * m_jitter.fraction())) : LineTime{};
}

void SimulatedBus::planPings(std::vector<std::pair<Servo *, Reaction>> pings)
{
    if (pings.empty())
        return;
    std::ranges::stable_sort(pings, {}, [](const auto &ping) { return ping.second.status.id; });
    std::vector<PingSlot> turns;
    for (const auto &ping : pings)
        turns.push_back({ping.second.status.id, ping.second.delay, duration(ping.second)});
    const std::vector<LineTime> times = pingTimes(pings.front().second.heardAt, turns);
    for (std::size_t i = 0; i < pings.size(); ++i) {
        Scheduled reply;
        reply.at = times[i] + jitter();
        reply.servo = pings[i].first;
        reply.baudRate = pings[i].second.baudRate;
        reply.bytes = encode(pings[i].second.status);
        reply.status = std::move(pings[i].second.status);
        reply.givesUp = true;
        m_scheduled.push_back(std::move(reply));
    }
}

void SimulatedBus::joinChain(Servo *servo, Reaction reaction)
{
    const auto same = std::ranges::find_if(m_chains, [&](const auto &chain) {
        return chain->heardAt == reaction.heardAt && chain->group.spans == reaction.group.spans;
    });
    std::shared_ptr<Chain> chain = same != m_chains.end() ? *same : nullptr;
    if (!chain) {
        chain = std::make_shared<Chain>();
        chain->heardAt = reaction.heardAt;
        chain->group = std::move(reaction.group);
        m_chains.push_back(chain);
    }
    chain->waiting.push_back({servo, reaction.index, reaction.delay, reaction.baudRate, std::move(reaction.status)});
}

void SimulatedBus::continueChain(const std::shared_ptr<Chain> &chain, std::size_t index, LineTime from)
{
    for (const Chain::Member &member : chain->waiting) {
        if (member.index != index)
            continue;
        Scheduled reply;
        reply.at = from + member.delay + jitter();
        reply.servo = member.servo;
        reply.baudRate = member.baudRate;
        reply.bytes = chainBytes(*chain, index, member.status);
        reply.status = member.status;
        reply.givesUp = true;
        reply.chain = chain;
        reply.index = index;
        m_scheduled.push_back(std::move(reply));
    }
    std::erase_if(chain->waiting, [index](const Chain::Member &member) { return member.index == index; });
    std::erase_if(m_chains, [](const auto &one) { return one->waiting.empty(); });
}

void SimulatedBus::hearServo(const Transmission &sent)
{
    if (sent.chain && !sent.damaged)
        continueChain(sent.chain, sent.index + 1, sent.end());
}

void SimulatedBus::begin(Scheduled &reply)
{
    if (!reply.servo->isPowered() || isAmong(m_faults.silent, *reply.servo) || isAmong(m_faults.deaf, *reply.servo))
        return;
    Transmission sent;
    sent.begin = reply.at;
    sent.baudRate = reply.baudRate;
    sent.sender = reply.servo;
    sent.bytes = std::move(reply.bytes);
    sent.chain = std::move(reply.chain);
    sent.index = reply.index;
    ReplySpoiler::Spoiled spoiled = m_spoiler->spoil(std::move(sent), reply.status);
    for (Transmission &one : spoiled.sent)
        m_wire->begin(std::move(one));
    if (spoiled.reboots) {
        reply.servo->advanceTo(reply.at);
        reply.servo->powerCycle();
    }
}

} // namespace dynascope::sim
