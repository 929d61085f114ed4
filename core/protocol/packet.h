// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/protocol/protocol_values.h"

namespace dynascope {

/// What a controller puts on the wire. Parameters are as meant, not stuffed.
struct InstructionPacket {
    std::uint8_t id = 0; ///< 0..252, or BroadcastId
    Instruction instruction = Instruction::Ping;
    Bytes parameters;

    friend bool operator==(const InstructionPacket &, const InstructionPacket &) = default;
};

/// What a device answers. Parameters are as meant, not stuffed.
struct StatusPacket {
    std::uint8_t id = 0;
    DeviceError error = DeviceError::None;
    bool alert = false; ///< rides beside a valid answer: Hardware Error Status is not 0
    Bytes parameters;

    std::uint8_t errorField() const { return static_cast<std::uint8_t>(error) | (alert ? AlertBit : 0); }

    friend bool operator==(const StatusPacket &, const StatusPacket &) = default;
};

/// One device's part of a fast reply.
using FastBlock = StatusPacket;

/// The bytes of a packet, header to CRC. An instruction may come out longer than MaximumPacketSize: the caller splits.
Bytes encode(const InstructionPacket &packet);
Bytes encode(const StatusPacket &packet);

/// A whole answer to Fast Sync Read or Fast Bulk Read: not stuffed, each block closed by the CRC of all bytes so far.
/// Every block's parameters have the length that the request asked for, also beside an error.
Bytes encodeFastStatus(std::span<const FastBlock> blocks);

constexpr int HeaderSize = 7;           ///< FF FF FD 00, ID, LEN
constexpr std::size_t LengthAt = 5;     ///< where LEN begins, two bytes, little-endian
constexpr int InstructionOverhead = 10; ///< a whole instruction packet without parameters
constexpr int StatusOverhead = 11;      ///< a whole status packet without parameters
constexpr int FastBlockOverhead = 4;    ///< ERR, ID, CRC around each block's data

} // namespace dynascope
