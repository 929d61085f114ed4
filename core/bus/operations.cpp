// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"

#include "core/bus/messages.h"
#include "core/bus/readplan.h"

namespace dynascope {

using namespace std::chrono_literals;

bool mayHaveArrived(const Error &error)
{
    switch (error.kind) {
    case ErrorKind::NothingReceived:
    case ErrorKind::NoHeader:
    case ErrorKind::CutOff:
    case ErrorKind::DamagedCrc:
    case ErrorKind::WrongId:
    case ErrorKind::WrongLength:
    case ErrorKind::LateAnswer: return true;
    default: return false;
    }
}

bool endsAll(const Error &error)
{
    return error.kind == ErrorKind::Cancelled || error.kind == ErrorKind::Stopped || error.kind == ErrorKind::PortLost;
}

namespace {

Result<Reply> single(Bus &bus, const Request &request, int retries = 2)
{
    Result<ExchangeResult> result = bus.exchange(request, retries);
    if (!result)
        return tl::unexpected(result.error());
    if (result->replies.empty()) // a broadcast: nobody answers
        return Reply{request.packet.id, DeviceError::None, false, {}, bus.line().now()};
    Result<Reply> &reply = result->replies.front();
    if (!reply && (mayHaveArrived(reply.error()) || reply.error().kind == ErrorKind::NotSent)) {
        if (const auto others = bus.othersAlive(request.packet.id))
            return tl::unexpected(messages::withOthers(std::move(reply.error()), *others));
    }
    return std::move(reply);
}

Result<void> outcome(const Result<Reply> &reply)
{
    if (!reply)
        return tl::unexpected(reply.error());
    return {};
}

std::vector<Traits> traitsOf(const Bus &bus, const auto &items)
{
    std::vector<Traits> traits;
    for (const auto &item : items)
        traits.push_back(bus.traits(item.id));
    return traits;
}

} // namespace

Result<PingReply> ping(Bus &bus, std::uint8_t id)
{
    const Result<Reply> reply = single(bus, pingRequest(id));
    if (!reply)
        return tl::unexpected(reply.error());
    const ByteView data = reply->data;
    return PingReply{reply->id, static_cast<std::uint16_t>(littleEndian(data, 2)), data[2], reply->alert};
}

Result<ReadReply> read(Bus &bus, const Span &span)
{
    Result<Reply> reply = single(bus, readRequest(span));
    if (!reply)
        return tl::unexpected(reply.error());
    return ReadReply{std::move(reply->data), reply->alert, reply->at};
}

Result<void> write(Bus &bus, const SpanData &data, int retries)
{
    return outcome(single(bus, writeRequest(data), retries));
}

Result<void> regWrite(Bus &bus, const SpanData &data)
{
    return outcome(single(bus, regWriteRequest(data)));
}

Result<void> action(Bus &bus, std::uint8_t id)
{
    return outcome(single(bus, actionRequest(id)));
}

Result<void> factoryReset(Bus &bus, std::uint8_t id, ResetOption option)
{
    return outcome(single(bus, factoryResetRequest(id, option)));
}

Result<void> reboot(Bus &bus, std::uint8_t id)
{
    return outcome(single(bus, rebootRequest(id)));
}

Result<void> clear(Bus &bus, std::uint8_t id, ClearOption option)
{
    return outcome(single(bus, clearRequest(id, option)));
}

Result<void> backup(Bus &bus, std::uint8_t id, BackupOption option)
{
    return outcome(single(bus, backupRequest(id, option)));
}

Result<std::vector<Result<ReadReply>>> readMany(Bus &bus, std::span<const Span> spans)
{
    std::vector<Result<ReadReply>> values(spans.size());
    for (const PlannedExchange &planned : planReads(spans, traitsOf(bus, spans))) {
        Result<ExchangeResult> result = bus.exchange(planned.request);
        if (!result)
            return tl::unexpected(result.error());
        for (std::size_t i = 0; i < planned.indices.size(); ++i) {
            Result<Reply> &reply = result->replies[i];
            Result<ReadReply> &value = values[planned.indices[i]];
            if (reply)
                value = ReadReply{std::move(reply->data), reply->alert, reply->at};
            else
                value = tl::unexpected(reply.error());
        }
    }
    return values;
}

Result<void> writeMany(Bus &bus, std::span<const SpanData> writes)
{
    for (const Request &request : planWrites(writes, traitsOf(bus, writes))) {
        if (Result<ExchangeResult> sent = bus.exchange(request); !sent)
            return tl::unexpected(sent.error());
    }
    return {};
}

Result<Bytes> writeVerified(Bus &bus, const SpanData &data)
{
    const Result<void> written = write(bus, data);
    if (!written && !mayHaveArrived(written.error()))
        return tl::unexpected(written.error());
    constexpr int Looks = 5;
    const auto length = static_cast<std::uint16_t>(data.data.size());
    Bytes shown;
    std::optional<Error> unseen; // why the first look showed nothing
    for (int look = 0; look < Looks; ++look) {
        if (look > 0) {
            if (Result<void> waited = bus.wait(20ms); !waited)
                return tl::unexpected(waited.error());
        }
        // While its EEPROM is being written a device may be deaf: not before the last look that is its last word.
        Result<Reply> reply = single(bus, readRequest({data.id, data.address, length}), look == 0 ? 2 : 0);
        if (reply && reply->data == data.data)
            return std::move(reply->data);
        if (reply) {
            shown = std::move(reply->data);
            continue;
        }
        unseen = unseen.value_or(reply.error());
        const bool mayHearLater = mayHaveArrived(reply.error()) || reply.error().kind == ErrorKind::NotSent;
        if (!mayHearLater)
            return tl::unexpected(messages::mayBeWritten(written ? reply.error() : written.error()));
    }
    if (shown.empty())
        return tl::unexpected(messages::mayBeWritten(written ? *unseen : written.error()));
    if (!written) // the answer was lost, and reading back shows that the write was, too
        return tl::unexpected(messages::notWritten(written.error(), data.data, shown));
    return tl::unexpected(messages::notConfirmed(data.id, data.data, shown));
}

} // namespace dynascope
