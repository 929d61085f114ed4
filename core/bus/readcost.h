// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/bus/traits.h"
#include "core/protocol/requests.h"

namespace dynascope {

/// What a line adds to what its wire takes: known, or measured while it polls (PollMeasure). A value.
struct LineDelays {
    LineTime latencyTimer{};  ///< the adapter holds what came for so long, or until it has `latencyBuffer` bytes
    int latencyBuffer = 62;
    LineTime perExchange{};   ///< on average above all else; below 0 where the timer is faster than it says
    LineTime perCycle{};      ///< between one cycle and the next
    LineTime probe{};         ///< so long a silent device is waited for when it is asked anew; 0: not measured yet

    friend bool operator==(const LineDelays &, const LineDelays &) = default;
};

/// What one exchange takes whose every answer comes, by what it is for. Reference "Time".
struct ExchangeCost {
    LineTime request{};     ///< its bytes
    LineTime replies{};     ///< their bytes
    LineTime returnDelay{}; ///< Return Delay Time of those who pay it
    LineTime thinking{};    ///< until a device answers besides
    LineTime latency{};     ///< adapter and host
    std::size_t bytes = 0;  ///< on the wire, nothing stuffed

    LineTime total() const { return request + replies + returnDelay + thinking + latency; }
    ExchangeCost &operator+=(const ExchangeCost &other);
};

/// Of whom how much is read.
struct AskedDevice {
    std::uint16_t length = 0;
    LineTime returnDelay{};
};
enum class ReadKind { Single, Sync, Bulk, FastSync, FastBulk };
constexpr bool isFast(ReadKind kind) { return kind == ReadKind::FastSync || kind == ReadKind::FastBulk; }

/// How a device's Return Delay Time counts before any answer; of who isn't in `traits`: what it is fresh.
LineTime returnDelayOf(std::uint8_t id, std::span<const Traits> traits);

/// In the order of the request. Pure.
ExchangeCost costOf(ReadKind kind, std::span<const AskedDevice> asked, LineTime byteTime, const LineDelays &delays);
/// The same of a request that reads.
ExchangeCost costOf(const Request &request, std::span<const Traits> traits, LineTime byteTime,
                    const LineDelays &delays);

} // namespace dynascope
