// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/readchoice.h"

namespace dynascope {

/// A request, and the spans it answers by their position in what was planned.
struct PlannedExchange {
    Request request;
    std::vector<std::size_t> indices; ///< in reply order
    std::vector<std::size_t> replies; ///< of each: the reply that holds it; planReads(): one each
    std::vector<std::uint16_t> begins; ///< of each reply: its first address
};

/// The cheapest requests for these spans as they are. Devices stand in each request in the order of `spans`. Devices
/// not in `traits` are taken for factory-fresh. Pure.
std::vector<PlannedExchange> planReads(std::span<const Span> spans, std::span<const Traits> traits);

/// The requests of one poll cycle, at what they cost on this line: spans of a device may be read in one, with what lies
/// between them. Pure.
std::vector<PlannedExchange> planExchanges(std::span<const PollSpan> spans, std::span<const Traits> traits,
                                           const ReadCosts &costs);

/// Sync Writes where several have the same address and length, else Bulk Writes. Pure.
std::vector<Request> planWrites(std::span<const SpanData> writes, std::span<const Traits> traits);

} // namespace dynascope
