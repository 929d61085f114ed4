// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"

namespace dynascope {

/// A stretch of registers to be read again and again.
struct PollSpan {
    quint32 device = 0; ///< the session's number of the device; the bus only hands it back
    Span span;
    std::chrono::milliseconds interval{0}; ///< 0: every cycle

    friend bool operator==(const PollSpan &, const PollSpan &) = default;
};

struct PollPlan {
    int baudRate = AnyRate; ///< bits per second; while the line works at another one nothing of it is read
    std::vector<PollSpan> spans;
    std::vector<Traits> traits; ///< of every device in `spans`
    std::vector<Traits> others; ///< of those that only jobs speak to, each for its own rate

    friend bool operator==(const PollPlan &, const PollPlan &) = default;
};

/// What one span brought in one cycle.
struct PollValue {
    quint32 device = 0;
    std::uint16_t address = 0;
    std::uint16_t length = 0; ///< as asked for
    Bytes data;               ///< empty where it failed
    Error error;              ///< where data is empty
    bool alert = false;
    bool answersPing = false; ///< where data is empty: its Pings are answered, as far as is known
    LineTime at{}; ///< when the reply had come, or when waiting for it ended
};

/// What one poll cycle brought, in the order of the plan.
struct Batch {
    quint64 cycle = 0;
    int baudRate = AnyRate; ///< that it was read at
    LineTime begin{}, end{};
    bool fullRate = false; ///< the cycle read the interval-0 spans: counts for the achieved rate
    std::vector<PollValue> values;
};

} // namespace dynascope
