// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/packet.h"

#include "core/protocol/crc16.h"
#include "core/protocol/stuffing.h"

namespace dynascope {
namespace {

Bytes beginPacket(std::uint8_t id)
{
    return {0xFF, 0xFF, 0xFD, 0x00, id, 0, 0};
}

void setLength(Bytes &packet, std::size_t length)
{
    packet[LengthAt] = static_cast<std::uint8_t>(length);
    packet[LengthAt + 1] = static_cast<std::uint8_t>(length >> 8);
}

Bytes closePacket(Bytes packet)
{
    setLength(packet, packet.size() - HeaderSize + 2);
    appendLittleEndian(packet, crc16(packet), 2);
    return packet;
}

} // namespace

Bytes encode(const InstructionPacket &packet)
{
    Bytes body{static_cast<std::uint8_t>(packet.instruction)};
    body.insert(body.end(), packet.parameters.begin(), packet.parameters.end());
    Bytes bytes = beginPacket(packet.id);
    appendStuffed(bytes, body);
    return closePacket(std::move(bytes));
}

Bytes encode(const StatusPacket &packet)
{
    Bytes body{static_cast<std::uint8_t>(Instruction::Status), packet.errorField()};
    body.insert(body.end(), packet.parameters.begin(), packet.parameters.end());
    Bytes bytes = beginPacket(packet.id);
    appendStuffed(bytes, body);
    return closePacket(std::move(bytes));
}

Bytes encodeFastStatus(std::span<const FastBlock> blocks)
{
    Bytes bytes = beginPacket(BroadcastId);
    std::size_t length = 1;
    for (const FastBlock &block : blocks)
        length += block.parameters.size() + FastBlockOverhead;
    setLength(bytes, length);
    bytes.push_back(static_cast<std::uint8_t>(Instruction::Status));
    for (const FastBlock &block : blocks) {
        bytes.push_back(block.errorField());
        bytes.push_back(block.id);
        bytes.insert(bytes.end(), block.parameters.begin(), block.parameters.end());
        appendLittleEndian(bytes, crc16(bytes), 2);
    }
    return bytes;
}

} // namespace dynascope
