// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/groupreply.h"

namespace dynascope::sim {
namespace {

constexpr LineTime AbsentSlot = std::chrono::milliseconds(3); ///< reference "Who answers, and when"
constexpr std::size_t FastPrefix = HeaderSize + 1;            ///< FF FF FD 00 FE LEN LEN 55

} // namespace

Bytes chainBytes(Chain &chain, const Chain::Member &member)
{
    if (!chain.group.fast)
        return encode(member.status);
    if (chain.blocks.empty()) {
        for (const Span &span : chain.group.spans)
            chain.blocks.push_back({span.id, DeviceError::None, false, Bytes(span.length, 0)});
    }
    chain.blocks[member.index] = member.status;
    // What stands behind a block has no part in it: encode the whole packet, cut this device's piece out.
    const Bytes whole = encodeFastStatus(chain.blocks);
    std::size_t begin = FastPrefix;
    for (std::size_t i = 0; i < member.index; ++i)
        begin += FastBlockOverhead + chain.group.spans[i].length;
    const std::size_t end = begin + FastBlockOverhead + chain.group.spans[member.index].length;
    if (member.index == 0)
        begin = 0;
    return Bytes(whole.begin() + static_cast<std::ptrdiff_t>(begin), whole.begin() + static_cast<std::ptrdiff_t>(end));
}

std::vector<LineTime> pingTimes(LineTime heardAt, std::span<const PingSlot> pings)
{
    std::vector<LineTime> times;
    LineTime at = heardAt;
    int nextId = 0;
    for (const PingSlot &ping : pings) {
        if (ping.id < nextId) { // a second device with this ID: speaks at the same time
            times.push_back(times.back());
            continue;
        }
        at += (ping.id - nextId) * AbsentSlot + ping.delay;
        times.push_back(at);
        at += ping.duration;
        nextId = ping.id + 1;
    }
    return times;
}

} // namespace dynascope::sim
