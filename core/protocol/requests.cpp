// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/requests.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace dynascope {
namespace {

constexpr std::array<std::uint8_t, 4> ClearPositionKey{0x44, 0x58, 0x4C, 0x22};
constexpr std::array<std::uint8_t, 4> ClearErrorKey{0x45, 0x52, 0x43, 0x4C};
constexpr std::array<std::uint8_t, 4> BackupKey{0x43, 0x54, 0x52, 0x4C};

Request singleRequest(std::uint8_t id, Instruction instruction, Bytes parameters, std::uint16_t replyLength = 0)
{
    Request request{{id, instruction, std::move(parameters)}, ReplyShape::None, {}};
    if (id != BroadcastId) {
        request.shape = ReplyShape::Single;
        request.replies.push_back({id, replyLength});
    }
    return request;
}

Request keyedRequest(std::uint8_t id, Instruction instruction, std::uint8_t option, ByteView key)
{
    Bytes parameters{option};
    parameters.insert(parameters.end(), key.begin(), key.end());
    return singleRequest(id, instruction, std::move(parameters));
}

Bytes addressAndData(const SpanData &write)
{
    Bytes parameters;
    parameters.reserve(2 + write.data.size());
    appendLittleEndian(parameters, write.address, 2);
    std::ranges::copy(write.data, std::back_inserter(parameters)); // gcc 12 is wrong about insert() here
    return parameters;
}

std::size_t stuffedAtWorst(std::size_t bytes)
{
    return bytes + bytes / 3;
}

} // namespace

bool Request::isIdempotent() const
{
    switch (packet.instruction) {
    case Instruction::Ping:
    case Instruction::Read:
    case Instruction::Write:
    case Instruction::SyncRead:
    case Instruction::SyncWrite:
    case Instruction::FastSyncRead:
    case Instruction::BulkRead:
    case Instruction::BulkWrite:
    case Instruction::FastBulkRead: return true;
    default: return false;
    }
}

bool Request::isWrite() const
{
    switch (packet.instruction) {
    case Instruction::Ping:
    case Instruction::Read:
    case Instruction::SyncRead:
    case Instruction::FastSyncRead:
    case Instruction::BulkRead:
    case Instruction::FastBulkRead: return false;
    default: return true;
    }
}

std::size_t Request::maximumReplySize() const
{
    std::size_t size = 0;
    switch (shape) {
    case ReplyShape::None: break;
    case ReplyShape::Anyone: size = (MaximumId + 1U) * (StatusOverhead + stuffedAtWorst(PingReplyLength)); break;
    case ReplyShape::Fast:
        size = HeaderSize + 1;
        for (const ExpectedReply &reply : replies)
            size += FastBlockOverhead + reply.length;
        break;
    case ReplyShape::Single:
    case ReplyShape::InOrder:
        for (const ExpectedReply &reply : replies)
            size += StatusOverhead + stuffedAtWorst(reply.length + 2U);
        break;
    }
    return size;
}

Request pingRequest(std::uint8_t id)
{
    Request request = singleRequest(id, Instruction::Ping, {}, PingReplyLength);
    if (id == BroadcastId)
        request.shape = ReplyShape::Anyone;
    return request;
}

Request readRequest(const Span &span)
{
    Bytes parameters;
    appendLittleEndian(parameters, span.address, 2);
    appendLittleEndian(parameters, span.length, 2);
    return singleRequest(span.id, Instruction::Read, std::move(parameters), span.length);
}

Request writeRequest(const SpanData &write)
{
    return singleRequest(write.id, Instruction::Write, addressAndData(write));
}

Request regWriteRequest(const SpanData &write)
{
    return singleRequest(write.id, Instruction::RegWrite, addressAndData(write));
}

Request actionRequest(std::uint8_t id)
{
    return singleRequest(id, Instruction::Action, {});
}

Request factoryResetRequest(std::uint8_t id, ResetOption option)
{
    return singleRequest(id, Instruction::FactoryReset, {static_cast<std::uint8_t>(option)});
}

Request rebootRequest(std::uint8_t id)
{
    return singleRequest(id, Instruction::Reboot, {});
}

Request clearRequest(std::uint8_t id, ClearOption option)
{
    return keyedRequest(id, Instruction::Clear, static_cast<std::uint8_t>(option),
        option == ClearOption::Position ? ClearPositionKey : ClearErrorKey);
}

Request backupRequest(std::uint8_t id, BackupOption option)
{
    return keyedRequest(id, Instruction::ControlTableBackup, static_cast<std::uint8_t>(option), BackupKey);
}

Request syncReadRequest(std::uint16_t address, std::uint16_t length, std::span<const std::uint8_t> ids, bool fast)
{
    Request request;
    request.packet = {BroadcastId, fast ? Instruction::FastSyncRead : Instruction::SyncRead, {}};
    request.shape = fast ? ReplyShape::Fast : ReplyShape::InOrder;
    appendLittleEndian(request.packet.parameters, address, 2);
    appendLittleEndian(request.packet.parameters, length, 2);
    for (const std::uint8_t id : ids) {
        request.packet.parameters.push_back(id);
        request.replies.push_back({id, length});
    }
    return request;
}

Request syncWriteRequest(std::span<const SpanData> writes)
{
    Request request;
    request.packet = {BroadcastId, Instruction::SyncWrite, {}};
    request.shape = ReplyShape::None;
    if (writes.empty())
        return request;
    appendLittleEndian(request.packet.parameters, writes.front().address, 2);
    appendLittleEndian(request.packet.parameters, static_cast<std::uint32_t>(writes.front().data.size()), 2);
    for (const SpanData &write : writes) {
        request.packet.parameters.push_back(write.id);
        request.packet.parameters.insert(request.packet.parameters.end(), write.data.begin(), write.data.end());
    }
    return request;
}

Request bulkReadRequest(std::span<const Span> spans, bool fast)
{
    Request request;
    request.packet = {BroadcastId, fast ? Instruction::FastBulkRead : Instruction::BulkRead, {}};
    request.shape = fast ? ReplyShape::Fast : ReplyShape::InOrder;
    for (const Span &span : spans) {
        request.packet.parameters.push_back(span.id);
        appendLittleEndian(request.packet.parameters, span.address, 2);
        appendLittleEndian(request.packet.parameters, span.length, 2);
        request.replies.push_back({span.id, span.length});
    }
    return request;
}

Request bulkWriteRequest(std::span<const SpanData> writes)
{
    Request request;
    request.packet = {BroadcastId, Instruction::BulkWrite, {}};
    request.shape = ReplyShape::None;
    for (const SpanData &write : writes) {
        request.packet.parameters.push_back(write.id);
        appendLittleEndian(request.packet.parameters, write.address, 2);
        appendLittleEndian(request.packet.parameters, static_cast<std::uint32_t>(write.data.size()), 2);
        request.packet.parameters.insert(request.packet.parameters.end(), write.data.begin(), write.data.end());
    }
    return request;
}

namespace {

using Decoded = tl::expected<Command, DeviceError>;

Decoded decodeKeyed(ByteView parameters, Instruction instruction)
{
    if (parameters.size() < 5)
        return tl::unexpected(DeviceError::DataLength);
    const std::uint8_t option = parameters[0];
    const ByteView key = parameters.subspan(1, 4);
    if (instruction == Instruction::ControlTableBackup) {
        if ((option == 1 || option == 2) && std::ranges::equal(key, BackupKey))
            return BackupCommand{static_cast<BackupOption>(option)};
    } else if (option == 1 && std::ranges::equal(key, ClearPositionKey)) {
        return ClearCommand{ClearOption::Position};
    } else if (option == 2 && std::ranges::equal(key, ClearErrorKey)) {
        return ClearCommand{ClearOption::Error};
    }
    return tl::unexpected(DeviceError::DataRange);
}

Decoded decodeReset(ByteView parameters)
{
    if (parameters.empty())
        return tl::unexpected(DeviceError::DataLength);
    if (parameters[0] != 0xFF && parameters[0] != 1 && parameters[0] != 2)
        return tl::unexpected(DeviceError::DataRange);
    return FactoryResetCommand{static_cast<ResetOption>(parameters[0])};
}

std::uint16_t word(ByteView parameters, std::size_t at)
{
    return static_cast<std::uint16_t>(littleEndian(parameters.subspan(at), 2));
}

Decoded decodeSync(ByteView parameters, Instruction instruction)
{
    if (parameters.size() < 4)
        return tl::unexpected(DeviceError::DataLength);
    const std::uint16_t address = word(parameters, 0);
    const std::uint16_t length = word(parameters, 2);
    const ByteView entries = parameters.subspan(4);
    if (instruction != Instruction::SyncWrite) {
        GroupReadCommand command{{}, instruction == Instruction::FastSyncRead};
        for (const std::uint8_t id : entries)
            command.spans.push_back({id, address, length});
        return command;
    }
    GroupWriteCommand command;
    const std::size_t step = 1U + length;
    for (std::size_t at = 0; at + step <= entries.size(); at += step) {
        const ByteView data = entries.subspan(at + 1, length);
        command.writes.push_back({entries[at], address, Bytes(data.begin(), data.end())});
    }
    return command;
}

Decoded decodeBulk(ByteView parameters, Instruction instruction)
{
    constexpr std::size_t EntrySize = 5;
    const bool isWrite = instruction == Instruction::BulkWrite;
    GroupReadCommand read{{}, instruction == Instruction::FastBulkRead};
    GroupWriteCommand write;
    while (parameters.size() >= EntrySize) {
        const Span span{parameters[0], word(parameters, 1), word(parameters, 3)};
        parameters = parameters.subspan(EntrySize);
        if (!isWrite) {
            read.spans.push_back(span);
            continue;
        }
        if (parameters.size() < span.length)
            return tl::unexpected(DeviceError::DataLength);
        const ByteView data = parameters.first(span.length);
        write.writes.push_back({span.id, span.address, Bytes(data.begin(), data.end())});
        parameters = parameters.subspan(span.length);
    }
    if (!parameters.empty())
        return tl::unexpected(DeviceError::DataLength);
    if (isWrite)
        return write;
    return read;
}

} // namespace

tl::expected<Command, DeviceError> decodeCommand(const InstructionPacket &packet)
{
    const ByteView parameters = packet.parameters;
    switch (packet.instruction) {
    case Instruction::Ping: return PingCommand{};
    case Instruction::Read:
        if (parameters.size() < 4)
            return tl::unexpected(DeviceError::DataLength);
        return ReadCommand{word(parameters, 0), word(parameters, 2)};
    case Instruction::Write:
    case Instruction::RegWrite:
        if (parameters.size() < 3)
            return tl::unexpected(DeviceError::DataLength);
        return WriteCommand{word(parameters, 0), Bytes(parameters.begin() + 2, parameters.end()),
            packet.instruction == Instruction::RegWrite};
    case Instruction::Action: return ActionCommand{};
    case Instruction::FactoryReset: return decodeReset(parameters);
    case Instruction::Reboot: return RebootCommand{};
    case Instruction::Clear:
    case Instruction::ControlTableBackup: return decodeKeyed(parameters, packet.instruction);
    case Instruction::SyncRead:
    case Instruction::FastSyncRead:
    case Instruction::SyncWrite: return decodeSync(parameters, packet.instruction);
    case Instruction::BulkRead:
    case Instruction::FastBulkRead:
    case Instruction::BulkWrite: return decodeBulk(parameters, packet.instruction);
    case Instruction::Status: break;
    }
    return tl::unexpected(DeviceError::Instruction);
}

} // namespace dynascope
