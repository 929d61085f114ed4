// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/pollprediction.h"
#include "core/bus/ratelimit_values.h"

namespace dynascope {

/// What is asked about.
struct PolledLine {
    PollPlan plan;
    int baudRate = 57600;
    LineDelays delays;
    std::vector<std::uint8_t> silent;
    std::vector<std::uint8_t> couldBeFast; ///< know fast reads, which are off for them in the plan

    /// The same, or so nearly that nobody would see another prediction.
    bool isLike(const PolledLine &other) const;
};

/// All that takes time, what takes most of it first; never empty. Pure.
std::vector<RateLimit> limitsOf(const PolledLine &line);

} // namespace dynascope
