// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"
#include "core/session/journal/undosequence.h"

namespace dynascope {

/// Takes entries of the journal back, or carries them out again, one after the other; each is an entry of the journal
/// itself. Ends at the first that is refused or fails: those before it are done, which their entries say. Never
/// switches torque on. GUI thread; owned by app.
class Undo : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(Result<void>)>;

    /// All outlive this. `commands` has a journal.
    Undo(Session &session, Commands &commands, QObject *parent = nullptr);

    bool isBusy() const { return m_busy; }
    /// Of this program's run: 0 where there is none.
    qint64 nextToUndo() const;
    qint64 nextToRedo() const;

    /// In any order: the newest is undone first, the oldest redone first.
    Consent missing() const { return m_sequence.missing(); } ///< what the last run() failed for want of
    void run(std::vector<qint64> numbers, Direction direction, const UndoOptions &options, Done done = {});

signals:
    void busyChanged();
    void finished(int carriedOut, const QString &problem); ///< empty: all of it

private:
    void next();
    void carryOut(UndoStep step);
    void take(const UndoStep &step, JournalNote note, const Result<UndoResult> &result);
    void update(const UndoStep &step, const UndoResult &result);
    void end();
    LineSession *lineOf(const JournalEntry &entry) const;

    Session &m_session;
    Commands &m_commands;
    UndoSequence m_sequence;
    Done m_done;
    bool m_busy = false;
};

} // namespace dynascope
