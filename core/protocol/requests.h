// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/protocol/packet.h"
#include "core/result.h"

#include <variant>

namespace dynascope {

/// A stretch of one device's control table.
struct Span {
    std::uint8_t id = 0;
    std::uint16_t address = 0;
    std::uint16_t length = 0;

    friend bool operator==(const Span &, const Span &) = default;
};

/// Bytes for one device's control table.
struct SpanData {
    std::uint8_t id = 0;
    std::uint16_t address = 0;
    Bytes data;

    friend bool operator==(const SpanData &, const SpanData &) = default;
};

/// How the answers to a request come.
enum class ReplyShape {
    None,      ///< nobody answers
    Single,    ///< one status packet
    InOrder,   ///< one status packet per device, in the order of the request (Sync Read, Bulk Read)
    Fast,      ///< one chained packet of all devices (Fast Sync Read, Fast Bulk Read)
    Anyone,    ///< one status packet of everyone who is there, in ID order (broadcast Ping)
};

struct ExpectedReply {
    std::uint8_t id = 0;
    std::uint16_t length = 0; ///< data bytes behind the error field

    friend bool operator==(const ExpectedReply &, const ExpectedReply &) = default;
};

constexpr std::uint16_t PingReplyLength = 3; ///< model number, firmware version

/// An instruction with what may answer it. Manual: "Instruction details".
struct Request {
    InstructionPacket packet;
    ReplyShape shape = ReplyShape::Single;
    std::vector<ExpectedReply> replies; ///< empty with None and Anyone

    bool isIdempotent() const; ///< may be sent again by itself after a lost answer
    bool isWrite() const;      ///< answered, if at all, only at Status Return Level 2: neither Ping nor a read
    /// The longest run of bytes that can answer: stuffing at its worst, every device present.
    std::size_t maximumReplySize() const;
};

/// @name The controller's side. IDs are 0..252 or, where the manual allows it, BroadcastId.
/// @{
Request pingRequest(std::uint8_t id);
Request readRequest(const Span &span);
Request writeRequest(const SpanData &write);
Request regWriteRequest(const SpanData &write);
Request actionRequest(std::uint8_t id);
Request factoryResetRequest(std::uint8_t id, ResetOption option);
Request rebootRequest(std::uint8_t id);
Request clearRequest(std::uint8_t id, ClearOption option);
Request backupRequest(std::uint8_t id, BackupOption option);
Request syncReadRequest(std::uint16_t address, std::uint16_t length, std::span<const std::uint8_t> ids, bool fast);
/// Every entry has the same address and data length.
Request syncWriteRequest(std::span<const SpanData> writes);
/// No ID stands twice.
Request bulkReadRequest(std::span<const Span> spans, bool fast);
Request bulkWriteRequest(std::span<const SpanData> writes);
/// @}

/// @name The device's side: what an instruction packet asks for.
/// @{
struct PingCommand {};
struct ReadCommand { std::uint16_t address; std::uint16_t length; };
struct WriteCommand { std::uint16_t address; Bytes data; bool registered; /**< Reg Write */ };
struct ActionCommand {};
struct FactoryResetCommand { ResetOption option; };
struct RebootCommand {};
struct ClearCommand { ClearOption option; };
struct BackupCommand { BackupOption option; };
/// Sync and Bulk Read: who is to answer with what, in this order.
struct GroupReadCommand { std::vector<Span> spans; bool fast; };
/// Sync and Bulk Write.
struct GroupWriteCommand { std::vector<SpanData> writes; };

using Command = std::variant<PingCommand, ReadCommand, WriteCommand, ActionCommand, FactoryResetCommand, RebootCommand,
                             ClearCommand, BackupCommand, GroupReadCommand, GroupWriteCommand>;

/// The command in a packet, or the number a device answers with: Instruction Error for an unknown instruction,
/// Data Length Error for missing parameters, Data Range Error for a wrong option or key.
tl::expected<Command, DeviceError> decodeCommand(const InstructionPacket &packet);
/// @}

} // namespace dynascope
