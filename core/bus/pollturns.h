// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/readplan.h"

namespace dynascope {

/// Spans of one interval that are read in the same cycle. `interval` 0: those of every cycle.
struct PollTurn {
    std::chrono::milliseconds interval{0};
    std::vector<std::size_t> spans; ///< of the plan
};

/// Beside what is read in every cycle the rest takes turns, at most one in a cycle and each one exchange that takes no
/// longer than about a quarter of such a cycle where that can be: so no cycle is much longer than another. Where
/// nothing is read in every cycle, there is one turn an interval. The first turn is that of interval 0, if there is
/// one. Pure.
std::vector<PollTurn> turnsOf(const PollPlan &plan, const ReadCosts &costs);

/// What one cycle sends for these spans of the plan: what is cheaper, all planned as one, or what is read in every
/// cycle by itself and the rest by itself. `indices` of the result are of the plan. Pure.
std::vector<PlannedExchange> planCycle(const PollPlan &plan, std::span<const std::size_t> spans,
                                       std::span<const Traits> traits, const ReadCosts &costs);
ExchangeCost costOf(std::span<const PlannedExchange> exchanges, std::span<const Traits> traits, const ReadCosts &costs);

} // namespace dynascope
