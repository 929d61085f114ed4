// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/poll_values.h"
#include "core/bus/readcost.h"

#include <bitset>

namespace dynascope {

/// What decides which reads are the cheapest.
struct ReadCosts {
    LineTime byteTime = std::chrono::microseconds(10);
    LineDelays delays;
    bool mayJoin = false;     ///< spans of one device, with what lies between them, where that is cheaper
    std::bitset<256> unjoined; ///< but not of these IDs: they refuse it
};

/// One read, and the spans it answers: `spans[i]` by reply `replies[i]`, in the order of the replies.
struct ChosenRead {
    ReadKind kind = ReadKind::Single;
    std::vector<Span> asked; ///< one per reply
    std::vector<std::size_t> spans, replies;

    Request request() const;
};

constexpr int LongestJoined = 200; ///< bytes of one device in one reply

/// The cheapest reads for these spans: each device once in each, in the order in which the devices stand in `spans`, no
/// packet longer than a buffer takes. Devices that answer no group read are asked alone; those not in `traits` are
/// taken for factory-fresh. Not every way is looked at, but no small one is missed (tst_readchoice). Pure.
std::vector<ChosenRead> chooseReads(std::span<const Span> spans, std::span<const Traits> traits,
                                    const ReadCosts &costs);

ExchangeCost costOf(std::span<const ChosenRead> reads, std::span<const Traits> traits, const ReadCosts &costs);

/// Parameters that fit a device's buffer however they are stuffed.
std::size_t parameterLimit(int receiveBuffer);

} // namespace dynascope
