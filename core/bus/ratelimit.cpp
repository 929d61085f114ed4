// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/ratelimit.h"

#include <algorithm>

namespace dynascope {
namespace {

using namespace std::chrono_literals;
using What = RateLimit::What;

constexpr double Notable = 0.005;         ///< of the time: less is not worth a word
constexpr LineTime ShortestTimer = 1ms;   ///< an adapter's
constexpr std::chrono::microseconds NoReturnDelay{8}; ///< Traits::returnDelay with the register at 0
constexpr double Better = 1.02;           ///< so much faster, or a remedy is none

PollPrediction predict(const PolledLine &line)
{
    return predictPoll(line.plan, line.baudRate, line.delays, line.silent);
}

std::vector<std::uint8_t> slowToReturn(const PollPlan &plan)
{
    std::vector<std::uint8_t> ids;
    for (const Traits &device : plan.traits) {
        if (device.returnDelayKnown && device.returnDelay > NoReturnDelay)
            ids.push_back(device.id);
    }
    return ids;
}

PolledLine withoutReturnDelay(PolledLine line)
{
    for (Traits &device : line.plan.traits)
        device.returnDelay = std::min(device.returnDelay, NoReturnDelay);
    return line;
}

PolledLine withShortTimer(PolledLine line)
{
    line.delays.latencyTimer = std::min(line.delays.latencyTimer, ShortestTimer);
    return line;
}

PolledLine withFastReads(PolledLine line)
{
    for (Traits &device : line.plan.traits)
        device.fastReads = device.fastReads || std::ranges::find(line.couldBeFast, device.id) != line.couldBeFast.end();
    return line;
}

} // namespace

bool PolledLine::isLike(const PolledLine &other) const
{
    const auto near = [](LineTime one, LineTime two) {
        return std::chrono::abs(one - two) <= std::max<LineTime>(5us, std::chrono::abs(two) / 32);
    };
    return baudRate == other.baudRate && silent == other.silent && couldBeFast == other.couldBeFast
        && delays.latencyTimer == other.delays.latencyTimer && near(delays.perExchange, other.delays.perExchange)
        && near(delays.perCycle, other.delays.perCycle) && near(delays.probe, other.delays.probe) && plan == other.plan;
}

std::vector<RateLimit> limitsOf(const PolledLine &line)
{
    const PollPrediction now = predict(line);
    if (now.cycleRate <= 0 && now.met >= 1)
        return {RateLimit{}};
    std::vector<RateLimit> limits;
    const auto add = [&](What what, double share, std::vector<std::uint8_t> devices) {
        if (share >= Notable)
            limits.push_back({what, share, false, 0, std::move(devices)});
    };
    const auto remedy = [&](What what, const PolledLine &better) {
        const auto at = std::ranges::find(limits, what, &RateLimit::what);
        if (at == limits.end())
            return;
        const PollPrediction then = predict(better);
        at->rateWithout = then.cycleRate;
        at->hasRemedy = now.cycleRate > 0 ? then.cycleRate > now.cycleRate * Better : then.met > now.met * Better;
    };
    const PollPrediction fast = line.couldBeFast.empty() ? now : predict(withFastReads(line));
    add(What::Baud, now.shares.bytes(), {});
    if (std::vector<std::uint8_t> slow = slowToReturn(line.plan); !slow.empty())
        add(What::ReturnDelay, now.shares.returnDelay, std::move(slow));
    add(What::LatencyTimer, now.shares.latency, {});
    add(What::SilentDevice, now.shares.silence, line.silent);
    add(What::Devices, now.shares.thinking, {});
    if (fast.cycleRate > 0) // the time that plain reads take more
        add(What::PlainReads, 1 - now.cycleRate / fast.cycleRate, line.couldBeFast);
    remedy(What::ReturnDelay, withoutReturnDelay(line));
    remedy(What::PlainReads, withFastReads(line));
    if (line.delays.latencyTimer > ShortestTimer)
        remedy(What::LatencyTimer, withShortTimer(line));
    std::ranges::stable_sort(limits, std::greater(), &RateLimit::share);
    if (limits.empty())
        limits.emplace_back();
    return limits;
}

} // namespace dynascope
