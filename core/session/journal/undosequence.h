// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/undoplan.h"

#include <map>

namespace dynascope {

/// The steps that take several entries back, or carry them out again, one after the other: the newest is undone first,
/// the oldest redone first. What a device would not take yet (a goal beyond a limit that is put back later, or one that
/// would turn torque on) is tried again at the end. Ends at the first failure; those before it are done. A value.
class UndoSequence
{
public:
    UndoSequence() = default;
    UndoSequence(std::vector<qint64> numbers, Direction direction, const UndoOptions &options);

    /// Nothing: it is over, see outcome(). Each step is carried out and taken before the next is asked for.
    std::optional<UndoStep> next(const JournalEntries &entries, const Catalog &catalog);
    void take(const UndoStep &step, const Result<UndoResult> &result);
    void fail(const Error &error); ///< of a step that could not be carried out

    int carriedOut() const { return m_carriedOut; } ///< entries
    /// Once it is over: what it failed at.
    const Result<void> &outcome() const { return m_outcome; }
    Consent missing() const { return m_missing; } ///< it failed for want of that

private:
    using Place = std::pair<int, int>; ///< baud rate, ID
    struct Left {
        UndoStep step; ///< of this register alone
        QString why;
        bool isMain = false; ///< what the entry is about
    };

    void prepare(UndoStep &step) const;
    void follow(const UndoStep &step, const Found &moved);
    bool beginRound();
    void end();

    std::vector<qint64> m_waiting; ///< the next one last
    Direction m_direction = Direction::Undo;
    UndoOptions m_options;
    std::map<std::pair<Place, std::uint16_t>, Left> m_left; ///< by register
    std::vector<std::pair<Place, std::uint16_t>> m_round;   ///< of them, to be tried now
    std::size_t m_leftBefore = 0;                           ///< the round
    bool m_resting = false, m_over = false;
    int m_carriedOut = 0;
    Result<void> m_outcome;
    Consent m_missing = Consent::None;
};

} // namespace dynascope
