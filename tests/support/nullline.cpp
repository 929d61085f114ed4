// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/nullline.h"

#include <algorithm>

using namespace dynascope;

namespace {

Bytes answerTo(ByteView request)
{
    const int code = request[7];
    const auto word = [&](std::size_t at) { return static_cast<std::size_t>(request[at] + 256 * request[at + 1]); };
    const Bytes data(word(10), 7);
    if (code == static_cast<int>(Instruction::Read))
        return encode(StatusPacket{request[4], DeviceError::None, false, data});
    Bytes all;
    std::vector<FastBlock> blocks;
    for (std::size_t i = 12; i + 2 < request.size(); ++i) { // Sync Read
        blocks.push_back({request[i], DeviceError::None, false, data});
        const Bytes one = encode(blocks.back());
        all.insert(all.end(), one.begin(), one.end());
    }
    return code == static_cast<int>(Instruction::FastSyncRead) ? encodeFastStatus(blocks) : all;
}

} // namespace

Result<void> NullLine::write(ByteView packet)
{
    auto known =
        std::ranges::find_if(m_known, [&](const Known &one) { return std::ranges::equal(one.request, packet); });
    if (known == m_known.end()) {
        m_known.push_back({Bytes(packet.begin(), packet.end()), answerTo(packet)});
        known = std::prev(m_known.end());
    }
    m_waiting = &known->answer;
    m_at = m_now + static_cast<LineTime::rep>(packet.size()) * byteTime();
    return {};
}

Result<void> NullLine::read(Bytes &buffer, LineTime deadline)
{
    if (!m_waiting || deadline < m_at) {
        m_now = std::max(m_now, deadline);
        return {};
    }
    m_now = m_at;
    buffer.insert(buffer.end(), m_waiting->begin(), m_waiting->end());
    m_waiting = nullptr;
    return {};
}

PollPlan nullPlan(int devices, int length, bool fast, bool group)
{
    PollPlan plan;
    for (int id = 1; id <= devices; ++id) {
        Traits traits;
        traits.id = static_cast<std::uint8_t>(id);
        traits.returnDelay = {};
        traits.fastReads = fast;
        traits.groupReads = group;
        plan.traits.push_back(traits);
        plan.spans.push_back({static_cast<quint32>(id), {traits.id, 126, static_cast<std::uint16_t>(length)}, {}});
    }
    return plan;
}
