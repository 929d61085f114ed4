// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/pollturns.h"

namespace dynascope {

constexpr LineTime LongestProbeInterval = std::chrono::seconds(3); ///< of a silent device, once it has been for long

/// For what a line's time is used, each as a part of every second: their sum is 1 where something is read at full rate.
struct PollShares {
    double requests = 0;    ///< bytes of the requests
    double replies = 0;     ///< bytes of the answers
    double returnDelay = 0; ///< Return Delay Times
    double thinking = 0;    ///< what devices take to answer besides
    double latency = 0;     ///< adapter and host
    double silence = 0;     ///< waiting for devices that don't answer

    double bytes() const { return requests + replies; }
    double sum() const { return bytes() + returnDelay + thinking + latency + silence; }
};

/// What polling a plan will be like. A value.
struct PollPrediction {
    double cycleRate = 0; ///< of what is read at full rate, Hz; 0: nothing is
    double busLoad = 0;   ///< 0..1: part of the time in which the wire carries bytes
    PollShares shares;
    LineTime shortest{}; ///< cycle: what is read in every one
    LineTime longest{};  ///< with the dearest turn
    /// 0..1: so often comes what is wanted most often of that at intervals; what is wanted more rarely comes first.
    double met = 1;
    bool isKnown = false; ///< how each device answers has been read; otherwise it is taken for fresh
};

/// From bytes, Return Delay Times and what adapter and host add. `silent`: don't answer, by ID. Pure. Reference "Time".
PollPrediction predictPoll(const PollPlan &plan, int baudRate, const LineDelays &delays,
                           std::span<const std::uint8_t> silent = {});

} // namespace dynascope
