// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history.h"
#include "core/session/watch.h"

#include <functional>
#include <map>

namespace dynascope {

/// The histories of all that is or was watched, within one budget of memory. When it is used up, the oldest samples go
/// first and leave extremes (`History`); those may take up to seven sixteenths of the budget, then they are folded, too,
/// into fewer, and at last go. The newest up to 4096 samples of each stay, whatever the budget. Any one thread.
class Histories
{
public:
    static constexpr std::size_t DefaultBudget = std::size_t(512) << 20; ///< bytes

    explicit Histories(std::size_t budget = DefaultBudget) : m_budget(budget) { }

    std::size_t budget() const { return m_budget; }        ///< bytes
    std::size_t used() const { return m_memory.used(); }   ///< bytes, with what the heap takes for itself
    void setBudget(std::size_t bytes);                     ///< folds what is too much

    const History *find(const Watch &watch) const; ///< nullptr until its first sample
    void append(const Watch &watch, LineTime at, std::int32_t raw);
    /// That to which append() would append, for whoever has much to append: it stays where it is until it is erased.
    /// bound() then, now and again.
    History &open(const Watch &watch, LineTime at);
    void bound(); ///< folds what is too much
    void appendGap(const Watch &watch, LineTime at);
    void markGap(const Watch &watch); ///< behind its last sample
    void erase(const std::function<bool(const Watch &)> &which);
    void clear(); ///< all samples; what there was is there, empty

private:
    std::size_t slotFor(const Watch &watch, LineTime at) const;
    void fold();
    bool foldOne();
    bool foldOldest(Detail detail);

    HistoryMemory m_memory;
    std::map<Watch, History> m_histories;
    std::size_t m_budget;
    std::size_t m_least = 0; ///< bytes that couldn't be folded last time: no use to try again before there are more
};

} // namespace dynascope
