// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/timing.h"

#include <algorithm>

namespace dynascope::timing {

using namespace std::chrono_literals;

LineTime processing(Instruction instruction)
{
    switch (instruction) {
    case Instruction::Write:
    case Instruction::RegWrite:
    case Instruction::Action: return 50ms;
    case Instruction::FactoryReset:
    case Instruction::Reboot: return 300ms;
    case Instruction::Clear:
    case Instruction::ControlTableBackup: return 3s;
    default: return 100us;
    }
}

LineTime silence(const Line &line)
{
    return std::max<LineTime>(1500us, 10 * line.byteTime());
}

std::size_t largestStatus(std::size_t parameters)
{
    return StatusOverhead + parameters + (parameters + 2) / 3;
}

std::size_t largestPacket(const Request &request, std::size_t sentBytes)
{
    constexpr std::size_t ForAnotherLength = 64;
    std::size_t largest = largestStatus(PingReplyLength);
    if (request.shape == ReplyShape::Fast)
        largest = request.maximumReplySize();
    else
        for (const ExpectedReply &reply : request.replies)
            largest = std::max(largest, largestStatus(reply.length));
    return std::max(largest + ForAnotherLength, sentBytes);
}

} // namespace dynascope::timing
