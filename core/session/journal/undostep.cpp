// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalwrites.h"
#include "core/session/journal/undoplan.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"

namespace dynascope {
namespace {

bool isOurs(const Found &found, const UndoStep &step)
{
    return found.modelNumber == step.place.modelNumber && found.firmware == step.entry.device.firmware;
}

/// Where an earlier try may have brought it.
std::optional<Found> movedBefore(JobContext &context, const UndoStep &step)
{
    DevicePlace to = step.place;
    to.id = step.newId ? step.newId->newId : to.id;
    to.baudRate = step.newBaud ? step.newBaud->newBaudRate : to.baudRate;
    const auto found = look(context, to);
    return found && isOurs(*found, step) ? std::optional(*found) : std::nullopt;
}

} // namespace

Result<UndoResult> carryOut(JobContext &context, const UndoStep &step)
{
    UndoResult result;
    if (!step.newId && !step.newBaud) {
        auto reverted = revert(context, step.registers);
        if (!reverted)
            return tl::unexpected(reverted.error());
        result.registers = std::move(*reverted);
        return result;
    }
    const auto there = look(context, step.place);
    if (!there && there.error().kind == ErrorKind::NothingReceived && step.mayBeDone)
        result.moved = movedBefore(context, step);
    if (result.moved)
        return result;
    if (!there)
        return tl::unexpected(there.error());
    if (!isOurs(*there, step)) {
        return failure(ErrorKind::NotFound,
                       JournalText::tr("Another device answers as ID %1 at %2 bps, not %3; nothing was written")
                           .arg(step.place.id)
                           .arg(step.place.baudRate)
                           .arg(step.place.name));
    }
    const bool mayTurnOff = step.newId ? step.newId->turnTorqueOff : step.newBaud->turnTorqueOff;
    if (step.registers.torqueAddress && !mayTurnOff) {
        const AtBaud here(context.bus(), step.place.baudRate);
        const auto torque = read(context.bus(), {step.place.id, *step.registers.torqueAddress, 1});
        if (torque && torque->data.front() != 0) {
            result.registers.missing = Consent::TorqueOff;
            result.registers.why =
                JournalText::tr("%1 is under torque, which locks its EEPROM; nothing was written").arg(step.place.name);
            return result;
        }
    }
    auto found = step.newId ? changeId(context, *step.newId) : changeBaud(context, *step.newBaud);
    if (!found)
        return tl::unexpected(found.error());
    result.moved = *found;
    return result;
}

JournalEntry outcomeOf(const UndoStep &step, const Result<UndoResult> &result)
{
    JournalEntry outcome = step.entry;
    if (!result) {
        outcome.state = stateAfter(result.error());
        outcome.note = result.error().text;
        return outcome;
    }
    outcome.state = JournalState::Done;
    if (result->registers.missing != Consent::None) {
        outcome.state = JournalState::Failed;
        outcome.note = result->registers.why;
        return outcome;
    }
    if (result->moved) {
        outcome.movedTo = JournalPlace{result->moved->id, result->moved->baudRate};
        outcome.changes.front().shown = outcome.changes.front().after;
        return outcome;
    }
    for (RegisterChange &change : outcome.changes)
        change.shown = bytesIn(result->registers.after, change.address, change.after.size());
    QStringList notes;
    if (result->registers.torqueTurnedOff)
        notes << JournalText::tr("torque was turned off for it");
    if (result->registers.torqueStaysOff)
        notes << JournalText::tr("torque stays off");
    for (const LeftRegister &left : result->registers.left) {
        notes << left.why;
        if (left.what.address == outcome.changes.front().address)
            outcome.state = JournalState::Unconfirmed; // not undone
    }
    outcome.note = notes.join(QStringLiteral("; "));
    return outcome;
}

} // namespace dynascope
