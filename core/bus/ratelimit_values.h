// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace dynascope {

/// What holds polling up, and what it would be like without.
struct RateLimit {
    enum class What {
        Nothing,      ///< nothing is read at full rate, and what is wanted comes
        Baud,         ///< bytes on the wire
        ReturnDelay,  ///< Return Delay Times; remedy: 0
        LatencyTimer, ///< adapter and host; remedy: low latency, where the timer is longer than it must be
        PlainReads,   ///< fast reads are off that devices know; remedy: on
        SilentDevice, ///< waiting for those that don't answer
        Devices,      ///< the time they take to think
    };
    What what = What::Nothing;
    double share = 0;                  ///< 0..1: so much of the time goes there
    bool hasRemedy = false;
    double rateWithout = 0;            ///< Hz, cycles with the remedy, predicted; 0: nothing is read at full rate
    std::vector<std::uint8_t> devices; ///< that it lies with, by ID

    friend bool operator==(const RateLimit &, const RateLimit &) = default;
};

} // namespace dynascope
