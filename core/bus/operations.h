// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

/// One instruction each, as a function of Bus. Bus thread. Errors are ready to be shown: they name the device and say
/// what was seen.
namespace dynascope {

/// Was it sent, and is not known whether it arrived? Nothing was heard that says so.
bool mayHaveArrived(const Error &error);
/// Does it end a job whatever is still to be done? Cancelled, stopped, or the port is gone.
bool endsAll(const Error &error);

struct PingReply {
    std::uint8_t id = 0;
    std::uint16_t modelNumber = 0;
    std::uint8_t firmware = 0;
    bool alert = false;
};

struct ReadReply {
    Bytes data;
    bool alert = false;
    LineTime at{};
};

Result<PingReply> ping(Bus &bus, std::uint8_t id);
Result<ReadReply> read(Bus &bus, const Span &span);
/// `retries` 0 where a second write must not happen by itself: ID, baud rate.
Result<void> write(Bus &bus, const SpanData &data, int retries = 2);
Result<void> regWrite(Bus &bus, const SpanData &data);
Result<void> action(Bus &bus, std::uint8_t id);
Result<void> factoryReset(Bus &bus, std::uint8_t id, ResetOption option);
Result<void> reboot(Bus &bus, std::uint8_t id);
Result<void> clear(Bus &bus, std::uint8_t id, ClearOption option);
Result<void> backup(Bus &bus, std::uint8_t id, BackupOption option);

/// One entry per span, in their order. Same address and length: Sync Read, else Bulk Read; fast where every device can;
/// split where a packet would grow past 1024 bytes. A single span is a Read.
Result<std::vector<Result<ReadReply>>> readMany(Bus &bus, std::span<const Span> spans);
/// Sync Write or Bulk Write; nobody answers.
Result<void> writeMany(Bus &bus, std::span<const SpanData> writes);

/// Writes one register and reads it back until it shows (EEPROM takes a while). The value read is returned;
/// NotConfirmed where it differs in the end.
Result<Bytes> writeVerified(Bus &bus, const SpanData &data);

} // namespace dynascope
