// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/histories.h"

namespace dynascope {

void Histories::setBudget(std::size_t bytes)
{
    m_budget = bytes;
    fold();
}

const History *Histories::find(const Watch &watch) const
{
    const auto at = m_histories.find(watch);
    return at == m_histories.end() ? nullptr : &at->second;
}

void Histories::append(const Watch &watch, LineTime at, std::int32_t raw)
{
    open(watch, at).append(at, raw);
    bound();
}

History &Histories::open(const Watch &watch, LineTime at)
{
    auto place = m_histories.lower_bound(watch);
    if (place == m_histories.end() || place->first != watch)
        place = m_histories.emplace_hint(place, watch, History(m_memory, slotFor(watch, at)));
    return place->second;
}

void Histories::bound()
{
    if (m_memory.used() > std::max(m_budget, m_least))
        fold();
}

void Histories::appendGap(const Watch &watch, LineTime at)
{
    const auto place = m_histories.find(watch);
    if (place != m_histories.end())
        place->second.appendGap(at);
}

void Histories::markGap(const Watch &watch)
{
    const auto place = m_histories.find(watch);
    if (place != m_histories.end() && !place->second.isEmpty())
        place->second.appendGap(place->second.last().at);
}

void Histories::erase(const std::function<bool(const Watch &)> &which)
{
    std::erase_if(m_histories, [&which](const auto &entry) { return which(entry.first); });
    m_least = 0;
}

void Histories::clear()
{
    for (auto &[watch, history] : m_histories)
        history = History(m_memory);
    m_least = 0;
}

/// Beside the fields of its device that came in the same replies, or will.
std::size_t Histories::slotFor(const Watch &watch, LineTime at) const
{
    const History *best = nullptr;
    for (auto other = m_histories.lower_bound({watch.device, 0});
         other != m_histories.end() && other->first.device == watch.device; ++other) {
        if (!other->second.isEmpty() && (!best || other->second.last().at > best->last().at))
            best = &other->second;
    }
    return best ? best->slotFor(at) : 0;
}

void Histories::fold()
{
    while (m_memory.used() > m_budget && foldOne()) { }
    m_least = m_memory.used();
}

/// False where nothing is left that could be.
bool Histories::foldOne()
{
    if (m_memory.used(Detail::Fine) > m_budget / 4 && foldOldest(Detail::Fine))
        return true;
    if (m_memory.used(Detail::Coarse) > m_budget / 8 && foldOldest(Detail::Coarse))
        return true;
    if (m_memory.used(Detail::Whole) > m_budget / 16 && foldOldest(Detail::Whole))
        return true;
    return foldOldest(Detail::Samples) || foldOldest(Detail::Fine) || foldOldest(Detail::Coarse)
        || foldOldest(Detail::Whole);
}

bool Histories::foldOldest(Detail detail)
{
    History *oldest = nullptr;
    LineTime oldestAt{};
    for (auto &[watch, history] : m_histories) {
        const std::optional<LineTime> at = history.oldest(detail);
        if (!at || (oldest && *at >= oldestAt))
            continue;
        oldest = &history;
        oldestAt = *at;
    }
    if (oldest)
        oldest->foldOldest(detail);
    return oldest != nullptr;
}

} // namespace dynascope
