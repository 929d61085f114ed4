// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/groupreply.h"

#include "core/protocol/crc16.h"

namespace dynascope::sim {
namespace {

constexpr LineTime AbsentSlot = std::chrono::milliseconds(3); ///< reference "Who answers, and when"
constexpr std::size_t FastPrefix = HeaderSize + 1;            ///< FF FF FD 00 FE LEN LEN 55

} // namespace

Bytes chainBytes(Chain &chain, std::size_t index, const StatusPacket &status)
{
    if (!chain.group.fast)
        return encode(status);
    if (chain.blocks.empty()) {
        for (const Span &span : chain.group.spans)
            chain.blocks.push_back({span.id, DeviceError::None, false, Bytes(span.length, 0)});
    }
    // What stands behind a block has no part in it: encode the whole packet, go on from what stands before.
    Bytes packet = encodeFastStatus(chain.blocks);
    std::size_t begin = FastPrefix;
    for (std::size_t i = 0; i < index; ++i)
        begin += FastBlockOverhead + chain.group.spans[i].length;
    packet.resize(begin);
    packet.push_back(status.errorField());
    packet.push_back(status.id);
    packet.insert(packet.end(), status.parameters.begin(), status.parameters.end());
    appendLittleEndian(packet, crc16(packet), 2);
    if (status.parameters.size() == chain.group.spans[index].length)
        chain.blocks[index] = status;
    return index == 0 ? packet : Bytes(packet.begin() + static_cast<std::ptrdiff_t>(begin), packet.end());
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
