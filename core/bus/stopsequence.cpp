// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/stopsequence.h"

#include "core/bus/asking.h"
#include "core/bus/messages.h"
#include "core/bus/operations.h"
#include "core/bus/readplan.h"

#include <algorithm>
#include <set>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime Pause = 500us;       ///< behind an answer: servos and hosts are not exact
constexpr LineTime WireFreeLimit = 3ms; ///< longer than this STOP's first packet waits for no answer
constexpr LineTime Quiet = 2ms;
constexpr LineTime QuietLimit = 20ms;   ///< the second one, which may have a longer answer to let end
constexpr LineTime SecondLook = 50ms; ///< after who did not answer STOP

Result<void> sendAll(Bus &bus, const std::vector<Bytes> &packets)
{
    for (const Bytes &packet : packets) {
        if (Result<void> sent = bus.sendOnly(packet); !sent)
            return sent;
    }
    return {};
}

Result<void> sendTwice(Bus &bus, const std::vector<Bytes> &packets)
{
    if (packets.empty())
        return {};
    if (Result<void> sent = sendAll(bus, packets); !sent)
        return sent;
    if (Result<void> quiet = bus.letEnd(Quiet, QuietLimit); !quiet)
        return quiet;
    return sendAll(bus, packets);
}

SpanData torqueOff(const StopTarget &target)
{
    return {target.id, target.torqueAddress, {0}};
}

} // namespace

StopPlan::StopPlan(std::vector<StopTarget> targets) : m_targets(std::move(targets))
{
    for (const int baudRate : bauds())
        m_packets[baudRate] = make(baudRate);
}

std::vector<int> StopPlan::bauds() const
{
    std::set<int> rates;
    for (const StopTarget &target : m_targets)
        rates.insert(target.baudRate);
    return {rates.begin(), rates.end()};
}

const std::vector<Bytes> &StopPlan::packets(int baudRate) const
{
    static const std::vector<Bytes> nobody;
    const auto known = m_packets.find(baudRate);
    return known == m_packets.end() ? nobody : known->second;
}

std::vector<Bytes> StopPlan::make(int baudRate) const
{
    // Sync Writes by address, so that nothing hangs on what a model knows of Bulk Write.
    std::map<std::uint16_t, std::vector<SpanData>> byAddress;
    std::set<std::uint8_t> here;
    for (const StopTarget &target : m_targets) {
        if (target.baudRate == baudRate && here.insert(target.id).second)
            byAddress[target.torqueAddress].push_back(torqueOff(target));
    }
    std::vector<Bytes> packets;
    for (const auto &[address, group] : byAddress) {
        for (const Request &request : planWrites(group, {}))
            packets.push_back(encode(request.packet));
    }
    return packets;
}

Result<void> sendTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud)
{
    if (plan.targets().empty())
        return {};
    const int present = bus.line().baudRate();
    if (Result<void> freed = bus.letEnd(Pause, WireFreeLimit); !freed)
        return freed;
    std::vector<int> order = plan.bauds(); // where somebody moves, most likely, comes first
    std::ranges::stable_sort(order, {}, [=](int baudRate) { return baudRate == present ? 0 : baudRate == workingBaud ? 1 : 2; });
    for (const int baudRate : order) {
        if (baudRate != present && !bus.setBaudRate(baudRate))
            continue;
        if (Result<void> sent = sendTwice(bus, plan.packets(baudRate)); !sent)
            return sent;
    }
    (void)bus.setBaudRate(workingBaud); // where that fails the line is lost, or at a rate that it can do
    if (bus.lost())
        return tl::unexpected(*bus.lost());
    return {};
}

namespace {

Result<ReadReply> readTorque(Bus &bus, const StopTarget &target)
{
    if (Result<void> set = bus.setBaudRate(target.baudRate); !set)
        return tl::unexpected(set.error());
    const Result<PingReply> there = ping(bus, target.id);
    if (!there)
        return tl::unexpected(there.error());
    if (target.modelNumber != 0 && there->modelNumber != target.modelNumber)
        return tl::unexpected(messages::anotherModel(target.id, there->modelNumber, target.modelNumber));
    Result<ReadReply> value = read(bus, {target.id, target.torqueAddress, 1});
    if (!value || value->data[0] == 0)
        return value;
    if (Result<void> written = write(bus, torqueOff(target)); !written && written.error().kind == ErrorKind::Stopped)
        return tl::unexpected(written.error());
    return read(bus, {target.id, target.torqueAddress, 1});
}

/// `isElsewhere`: nobody polls it, who knows whether it is still there.
StopOutcome verifyOne(Bus &bus, const StopTarget &target, bool isElsewhere)
{
    const Asking asking(bus, isElsewhere);
    const Result<ReadReply> value = readTorque(bus, target);
    if (!value)
        return {target.device, false, value.error().text};
    if (value->data[0] != 0)
        return {target.device, false, messages::torqueStillOn(target.id)};
    return {target.device, true, {}};
}

} // namespace

std::vector<StopOutcome> verifyTorqueOff(Bus &bus, const StopPlan &plan, int workingBaud)
{
    std::vector<StopTarget> targets = plan.targets();
    // Those at the working rate first, then rate by rate: few switches.
    std::ranges::stable_sort(targets, {},
        [workingBaud](const StopTarget &target) { return target.baudRate == workingBaud ? 0 : target.baudRate; });
    std::vector<StopOutcome> outcomes;
    for (const StopTarget &target : targets) {
        outcomes.push_back(verifyOne(bus, target, target.baudRate != workingBaud));
        if (bus.isStopped() || bus.isCancelled())
            return {};
    }
    // A host or an adapter that was busy for a moment makes nobody unconfirmed.
    for (std::size_t i = 0; i < targets.size() && targets[i].baudRate == workingBaud; ++i) {
        if (outcomes[i].off)
            continue;
        (void)bus.wait(SecondLook);
        outcomes[i] = verifyOne(bus, targets[i], false);
        if (bus.isStopped() || bus.isCancelled())
            return {};
    }
    (void)bus.setBaudRate(workingBaud);
    return outcomes;
}

} // namespace dynascope
