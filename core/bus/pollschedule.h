// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/pollturns.h"

namespace dynascope {

/// When each span of a plan is due. What is not read in every cycle comes by turns (turnsOf): one a cycle, and more
/// only where they would come far too late. Allocates nothing but in setPlan() and setTurns().
class PollSchedule
{
public:
    /// Spans that stay keep their rhythm.
    void setPlan(std::span<const PollSpan> spans, LineTime now);
    void setTurns(std::vector<PollTurn> turns);

    LineTime due(std::size_t span) const { return m_spans[span].due; }
    /// Whose turn it is now, of those that `isAsked` says can be.
    template <class IsAsked>
    void choose(LineTime now, const IsAsked &isAsked)
    {
        beginChoice();
        for (std::size_t i = 0; i < m_spans.size(); ++i) {
            if (m_spans[i].due <= now && isAsked(i))
                consider(i);
        }
        endChoice(now);
    }
    bool isChosen(std::size_t span) const { return m_turns[m_spans[span].turn].chosen; }
    void taken(std::size_t span, LineTime now);

private:
    struct Entry {
        PollSpan span;
        LineTime due{};
        std::size_t turn = 0;
        bool isNew = true; ///< was not read yet
    };
    struct Turn {
        std::chrono::milliseconds interval{0};
        LineTime phase{};               ///< of the second reading after the first
        LineTime due = LineTime::max(); ///< while choosing
        bool chosen = false;
    };

    void beginChoice();
    void consider(std::size_t span);
    void endChoice(LineTime now);

    std::vector<Entry> m_spans;
    std::vector<Turn> m_turns;
    bool m_takesTurns = false;
};

} // namespace dynascope
