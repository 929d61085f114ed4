// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/pollschedule.h"

#include <algorithm>
#include <map>

namespace dynascope {

void PollSchedule::setPlan(std::span<const PollSpan> spans, LineTime now)
{
    std::vector<Entry> entries;
    for (const PollSpan &span : spans) {
        const auto old = std::ranges::find(m_spans, span, &Entry::span);
        entries.push_back({span, now, 0, true});
        if (old != m_spans.end()) {
            entries.back().due = old->due;
            entries.back().isNew = old->isNew;
        }
    }
    m_spans = std::move(entries);
    m_turns.clear();
}

void PollSchedule::setTurns(std::vector<PollTurn> turns)
{
    std::map<std::chrono::milliseconds, int> count, number;
    for (const PollTurn &turn : turns)
        ++count[turn.interval];
    m_turns.clear();
    m_takesTurns = count.contains(std::chrono::milliseconds(0));
    for (const PollTurn &turn : turns) {
        for (const std::size_t span : turn.spans)
            m_spans[span].turn = m_turns.size();
        // The first time at once, from then on spread over the interval.
        const LineTime phase = LineTime(turn.interval) * ++number[turn.interval] / count[turn.interval];
        m_turns.push_back({turn.interval, phase, LineTime::max(), false});
    }
}

void PollSchedule::beginChoice()
{
    for (Turn &turn : m_turns)
        turn = {turn.interval, turn.phase, LineTime::max(), false};
}

void PollSchedule::consider(std::size_t span)
{
    Turn &turn = m_turns[m_spans[span].turn];
    turn.due = std::min(turn.due, m_spans[span].due);
}

void PollSchedule::endChoice(LineTime now)
{
    bool anyFullRate = false;
    Turn *next = nullptr;
    for (Turn &turn : m_turns) {
        if (turn.due > now)
            continue;
        if (turn.interval.count() == 0) {
            turn.chosen = anyFullRate = true;
            continue;
        }
        if (!next || turn.due < next->due)
            next = &turn;
    }
    if (next)
        next->chosen = true;
    if (anyFullRate && m_takesTurns)
        return;
    for (Turn &turn : m_turns)
        turn.chosen = turn.due <= now;
}

void PollSchedule::taken(std::size_t span, LineTime now)
{
    Entry &entry = m_spans[span];
    const LineTime interval = entry.span.interval;
    const bool spreads = entry.isNew && m_takesTurns;
    entry.due = spreads ? now + m_turns[entry.turn].phase : entry.due + interval;
    entry.isNew = false;
    if (entry.due < now) // what was missed is not made up for; where there are more turns than cycles it waits again
        entry.due = interval.count() == 0 || m_takesTurns ? now : now + interval;
}

} // namespace dynascope
