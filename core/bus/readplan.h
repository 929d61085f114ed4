// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"

namespace dynascope {

/// The cheapest requests for these spans. Devices stand in each request in the order of `spans`. Devices not in
/// `traits` are taken for factory-fresh. Pure.
std::vector<PlannedExchange> planReads(std::span<const Span> spans, std::span<const Traits> traits);

/// Sync Writes where several have the same address and length, else Bulk Writes. Pure.
std::vector<Request> planWrites(std::span<const SpanData> writes, std::span<const Traits> traits);

} // namespace dynascope
