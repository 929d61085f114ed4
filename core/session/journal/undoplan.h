// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalentry.h"
#include "core/session/procedures/revert.h"
#include "core/table/controltable.h"

#include <deque>
#include <set>

/// Which entries of a journal can be undone or redone, and how. Pure.
namespace dynascope {

class Catalog;

enum class Direction { Undo, Redo };

using JournalEntries = std::deque<JournalEntry>;

/// Those that are taken back now.
std::set<qint64> undoneEntries(const JournalEntries &entries);
/// What undo, or redo, without a number means: of this program's run (empty: of all) the latest that is left. 0: none.
/// A new write ends what could be redone.
qint64 nextToUndo(const JournalEntries &entries, const QString &run = {});
qint64 nextToRedo(const JournalEntries &entries, const QString &run = {});
/// Why this entry can't be undone or redone at all, before any device is asked; empty: it can.
QString whyNot(const JournalEntries &entries, qint64 number, Direction direction);
/// The same for many: `undone` is what undoneEntries() says.
QString whyNot(const JournalEntries &entries, const std::set<qint64> &undone, qint64 number, Direction direction);

/// Where the device of this entry stands now, by the changes of ID and baud rate since.
JournalPlace placeNow(const JournalEntries &entries, const JournalEntry &entry);
/// Are both of one line, whatever its port is called today?
bool isSameLine(const JournalDevice &one, const JournalDevice &other);

struct UndoOptions {
    bool mayMove = false;          ///< goals may be put back under torque
    bool mayTurnTorqueOff = false; ///< where the EEPROM needs it, or torque was off before
};

/// How one entry is taken back or carried out again: registers, or the place of the device.
struct UndoStep {
    qint64 number = 0;
    Direction direction = Direction::Undo;
    JournalEntry entry;                ///< as the journal will have it, begun
    DevicePlace place;                 ///< where the device should be
    RevertPlan registers;              ///< where it does not move
    std::optional<ChangeIdPlan> newId; ///< else one of these
    std::optional<ChangeBaudPlan> newBaud;
    bool mayBeDone = false; ///< an earlier try sent that, and nobody knows whether it arrived: it may stand there already
};
Result<UndoStep> planUndo(const JournalEntries &entries, qint64 number, Direction direction, const Catalog &catalog,
                          const UndoOptions &options);

/// What a step came to.
struct UndoResult {
    std::optional<Found> moved;
    Reverted registers;
};
/// Bus thread.
Result<UndoResult> carryOut(JobContext &context, const UndoStep &step);
/// The journal's end of the step.
JournalEntry outcomeOf(const UndoStep &step, const Result<UndoResult> &result);

} // namespace dynascope
