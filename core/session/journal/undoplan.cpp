// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undoplan.h"

#include "core/session/deviceplace.h"
#include "core/session/journal/journalwrites.h"
#include "core/session/texts.h"
#include "core/table/catalog.h"

#include <algorithm>

namespace dynascope {
namespace {

const JournalEntry *find(const JournalEntries &entries, qint64 number)
{
    const auto at = std::ranges::lower_bound(entries, number, {}, &JournalEntry::number);
    return at == entries.end() || at->number != number ? nullptr : &*at;
}

/// Did it, or may it have, changed something that has an old value?
bool isRevertible(const JournalEntry &entry)
{
    return entry.kind == JournalKind::Write && entry.state != JournalState::Failed && entry.undoes == 0
           && entry.redoes == 0 && !entry.changes.empty() && !entry.changes.front().before.empty();
}

bool isPlain(const JournalEntry &entry)
{
    return entry.undoes == 0 && entry.redoes == 0 && entry.state != JournalState::Failed;
}

bool isOf(const JournalEntry &entry, const QString &run)
{
    return run.isEmpty() || entry.run == run;
}

bool isRegister(const RegisterChange &change, Known field)
{
    return change.name == nameOf(field);
}

/// Torque on is never carried out, so nothing that would be it is offered.
bool wouldSwitchOn(const JournalEntry &entry, Direction direction)
{
    const RegisterChange &main = entry.changes.front();
    const Bytes &to = direction == Direction::Undo ? main.before : main.after;
    return isRegister(main, Known::TorqueEnable) && !to.empty() && to.front() != 0;
}

bool overlaps(const Field &field, const RegisterChange &change)
{
    return field.address < change.address + static_cast<int>(lengthOf(change)) && field.end() > change.address;
}

RevertRegister revertRegister(const RegisterChange &change, Direction direction, const ControlTable *table)
{
    RevertRegister one;
    one.address = change.address;
    one.name = registerText(change);
    const Bytes &shown = change.shown.empty() ? change.after : change.shown;
    one.from = direction == Direction::Undo ? shown : change.before;
    one.to = direction == Direction::Undo ? change.before : change.after;
    one.isTorque = isRegister(change, Known::TorqueEnable);
    one.isGoal = !table; // nobody knows what it is
    for (const Field &field : table ? table->fields() : std::span<const Field>()) {
        if (!overlaps(field, change))
            continue;
        one.isGoal = one.isGoal || isGoal(field) || isIndirectData(field);
        one.isLocked = one.isLocked || field.needsTorqueOff();
        one.mayWait = one.mayWait && !isIndirectData(field);
    }
    const Field *only = table ? table->at(change.address) : nullptr; // written by its address it has no name
    if (only && only->size == lengthOf(change) && isIndirectData(*only)) {
        const Field *pointer =
            table->find(QString(only->name).replace(QLatin1String("Data"), QLatin1String("Address")));
        if (pointer && pointer->size == 2)
            one.indirectAddress = pointer->address;
    }
    return one;
}

/// A span by its address may hold Torque Enable among others.
bool hidesTorqueOn(const RevertRegister &one, const ControlTable *table)
{
    const Field *torque = table ? table->find(Known::TorqueEnable) : nullptr;
    if (!torque || one.isTorque)
        return false;
    const int at = torque->address - one.address;
    return at >= 0 && at < static_cast<int>(one.to.size()) && one.to[static_cast<std::size_t>(at)] != 0;
}

/// Several Indirect Data at once may be anything, torque too.
bool leadsNobodyKnowsWhere(const RevertRegister &one, const RegisterChange &change, const ControlTable *table)
{
    return table && !one.indirectAddress && std::ranges::any_of(table->fields(), [&](const Field &field) {
               return overlaps(field, change) && isIndirectData(field);
           });
}

/// What a write of `main` may change and didn't then: putting it back may.
void keepOthers(RevertPlan &plan, const RegisterChange &main, const ControlTable *table)
{
    const Field *field = table ? table->at(main.address) : nullptr;
    if (!field || field->size != main.after.size())
        return;
    for (const Field *other : affectedBy(*table, *field, true)) {
        const bool isPlanned = std::ranges::any_of(
            plan.registers, [other](const RevertRegister &each) { return each.address == other->address; });
        if (isPlanned || other == table->find(Known::TorqueEnable))
            continue;
        const RegisterChange change = changeOf(*other, Bytes(other->size));
        plan.kept.push_back(revertRegister(change, Direction::Redo, table));
    }
}

JournalEntry entryOf(const JournalEntry &of, Direction direction, const JournalPlace &place)
{
    JournalEntry entry;
    entry.by = JournalAuthor::Undo;
    entry.device = of.device;
    entry.device.id = place.id;
    entry.device.baudRate = place.baudRate;
    (direction == Direction::Undo ? entry.undoes : entry.redoes) = of.number;
    for (const RegisterChange &change : of.changes) {
        RegisterChange turned = change;
        turned.shown.clear();
        if (direction == Direction::Undo)
            std::swap(turned.before, turned.after);
        entry.changes.push_back(std::move(turned));
    }
    return entry;
}

Result<UndoStep> planMove(UndoStep step, const JournalEntry &entry, const ControlTable *table,
                          const UndoOptions &options)
{
    const RegisterChange &main = entry.changes.front();
    const bool isId = isRegister(main, Known::Id);
    const Field *field = table ? table->find(isId ? Known::Id : Known::BaudRate) : nullptr;
    if (!field || field->address != main.address || field->size != 1 || main.before.size() != 1
        || main.after.size() != 1)
        return failure(ErrorKind::InvalidArgument,
                       JournalText::tr("Entry %1 names a register that is not there").arg(entry.number));
    const int wanted = step.direction == Direction::Undo ? main.before.front() : main.after.front();
    const int held = step.direction == Direction::Undo ? main.after.front() : main.before.front();
    if (isId && wanted > MaximumId)
        return failure(
            ErrorKind::InvalidArgument,
            JournalText::tr("Entry %1 speaks of ID %2, which no device can have").arg(entry.number).arg(wanted));
    const std::optional<int> heldRate = table->baudRate(held), wantedRate = table->baudRate(wanted);
    if (isId ? step.place.id != held : step.place.baudRate != heldRate.value_or(0)) {
        return failure(ErrorKind::InvalidArgument,
                       JournalText::tr("%1 has moved since entry %2, to ID %3 at %4 bps; nothing was written")
                           .arg(step.place.name)
                           .arg(entry.number)
                           .arg(step.place.id)
                           .arg(step.place.baudRate));
    }
    step.entry.changes.resize(1); // torque, which had to go off for it, stays off
    if (isId) {
        step.newId = {step.place, static_cast<std::uint8_t>(wanted), main.address, options.mayTurnTorqueOff};
    } else if (wantedRate) {
        step.newBaud = {step.place, *wantedRate, static_cast<std::uint8_t>(wanted), main.address,
                        options.mayTurnTorqueOff};
    } else {
        return failure(ErrorKind::NotSupported, JournalText::tr("It isn't known which baud rate %1 is").arg(wanted));
    }
    return step;
}

/// A side effect that was put back later, by itself, takes nothing back.
bool isAboutTheSame(const JournalEntry *taken, const JournalEntry &by)
{
    return !taken
           || (!taken->changes.empty() && !by.changes.empty()
               && taken->changes.front().address == by.changes.front().address);
}

/// A later entry that stands and changed the register of this change, too; 0: none. Torque is not taken back anyway.
qint64 changedSince(const JournalEntries &entries, const JournalEntry &entry, const RegisterChange &what)
{
    if (isRegister(what, Known::TorqueEnable))
        return 0;
    const std::set<qint64> undone = undoneEntries(entries);
    JournalPlace place = entry.movedTo.value_or(JournalPlace{entry.device.id, entry.device.baudRate});
    for (const JournalEntry &later : entries) {
        const JournalPlace from{later.device.id, later.device.baudRate};
        if (later.number <= entry.number || from != place || later.device.modelNumber != entry.device.modelNumber
            || !isSameLine(later.device, entry.device) || later.state == JournalState::Failed)
            continue;
        const bool touches = std::ranges::any_of(later.changes, [&](const RegisterChange &change) {
            const bool follows = &change != &later.changes.front() && isGoalName(change.name);
            return !follows && change.address < what.address + static_cast<int>(lengthOf(what))
                   && what.address < change.address + static_cast<int>(lengthOf(change));
        });
        if (touches && isPlain(later) && !undone.contains(later.number))
            return later.number;
        place = later.movedTo.value_or(place);
    }
    return 0;
}

/// Nobody lived to note what the write made of this register: whatever it holds gives way, unless it was written since.
bool putsBackUnknown(const JournalEntries &entries, const JournalEntry &entry, const RegisterChange &change,
                     Direction direction)
{
    return direction == Direction::Undo && changedSince(entries, entry, change) == 0;
}

} // namespace

std::set<qint64> undoneEntries(const JournalEntries &entries)
{
    std::set<qint64> undone;
    for (const JournalEntry &entry : entries) {
        if (entry.state != JournalState::Done)
            continue;
        if (entry.undoes > 0 && isAboutTheSame(find(entries, entry.undoes), entry))
            undone.insert(entry.undoes);
        if (entry.redoes > 0 && isAboutTheSame(find(entries, entry.redoes), entry))
            undone.erase(entry.redoes);
    }
    return undone;
}

qint64 nextToUndo(const JournalEntries &entries, const QString &run)
{
    const std::set<qint64> undone = undoneEntries(entries);
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
        if (isOf(*entry, run) && isRevertible(*entry) && !undone.contains(entry->number)
            && !wouldSwitchOn(*entry, Direction::Undo))
            return entry->number;
    }
    return 0;
}

qint64 nextToRedo(const JournalEntries &entries, const QString &run)
{
    const std::set<qint64> undone = undoneEntries(entries);
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
        if (!isOf(*entry, run))
            continue;
        if (isPlain(*entry) && !undone.contains(entry->number))
            return 0; // something new since
        if (entry->undoes > 0 && entry->state == JournalState::Done && undone.contains(entry->undoes)) {
            const JournalEntry *taken = find(entries, entry->undoes);
            if (taken && isRevertible(*taken) && !wouldSwitchOn(*taken, Direction::Redo))
                return taken->number;
        }
    }
    return 0;
}

QString whyNot(const JournalEntries &entries, qint64 number, Direction direction)
{
    return whyNot(entries, undoneEntries(entries), number, direction);
}

QString whyNot(const JournalEntries &entries, const std::set<qint64> &undone, qint64 number, Direction direction)
{
    const JournalEntry *entry = find(entries, number);
    if (!entry)
        return JournalText::tr("The journal has no entry %1").arg(number);
    if (entry->undoes > 0)
        return JournalText::tr("Entry %1 is itself an undo: redo %2").arg(number).arg(entry->undoes);
    if (entry->redoes > 0)
        return JournalText::tr("Entry %1 is a redo: undo %2").arg(number).arg(entry->redoes);
    if (entry->kind != JournalKind::Write)
        return JournalText::tr("Entry %1 is no write of registers: what it changed isn't known").arg(number);
    if (entry->state == JournalState::Failed)
        return JournalText::tr("Entry %1 failed and changed nothing").arg(number);
    if (!isRevertible(*entry))
        return JournalText::tr("Entry %1 does not know what it replaced").arg(number);
    const bool isUndone = undone.contains(number);
    if (isUndone && direction == Direction::Undo)
        return JournalText::tr("Entry %1 is undone already").arg(number);
    if (!isUndone && direction == Direction::Redo)
        return JournalText::tr("Entry %1 is not undone").arg(number);
    if (wouldSwitchOn(*entry, direction))
        return JournalText::tr("Entry %1 would switch torque on, which is only ever done by hand").arg(number);
    return {};
}

bool isSameLine(const JournalDevice &one, const JournalDevice &other)
{
    if (!one.adapter.isEmpty() && !other.adapter.isEmpty())
        return one.adapter == other.adapter;
    return one.line == other.line;
}

JournalPlace placeNow(const JournalEntries &entries, const JournalEntry &entry)
{
    JournalPlace place = entry.movedTo.value_or(JournalPlace{entry.device.id, entry.device.baudRate});
    for (const JournalEntry &later : entries) {
        const JournalPlace from{later.device.id, later.device.baudRate};
        if (later.number > entry.number && later.movedTo && later.state != JournalState::Failed && from == place
            && later.device.modelNumber == entry.device.modelNumber && isSameLine(later.device, entry.device))
            place = *later.movedTo;
    }
    return place;
}

Result<UndoStep> planUndo(const JournalEntries &entries, qint64 number, Direction direction, const Catalog &catalog,
                          const UndoOptions &options)
{
    if (const QString why = whyNot(entries, number, direction); !why.isEmpty())
        return failure(ErrorKind::InvalidArgument, why);
    const JournalEntry &entry = *find(entries, number);
    const JournalPlace place = placeNow(entries, entry);
    if (place.id < 0 || place.id > MaximumId)
        return failure(ErrorKind::InvalidArgument,
                       JournalText::tr("Entry %1 speaks of ID %2, which no device can have").arg(number).arg(place.id));
    const ControlTablePtr table = catalog.find(entry.device.modelNumber, entry.device.firmware);
    UndoStep step;
    step.number = number;
    step.direction = direction;
    step.entry = entryOf(entry, direction, place);
    step.place.id = static_cast<std::uint8_t>(place.id);
    step.place.baudRate = place.baudRate;
    step.place.modelNumber = static_cast<std::uint16_t>(entry.device.modelNumber);
    step.place.name = deviceText(step.entry.device);
    const Field *torque = table ? table->find(Known::TorqueEnable) : nullptr;
    if (torque)
        step.registers.torqueAddress = step.place.torqueAddress = torque->address;
    const RegisterChange &main = entry.changes.front();
    step.mayBeDone = std::ranges::any_of(entries, [&](const JournalEntry &each) {
        const bool isTry = (direction == Direction::Undo ? each.undoes : each.redoes) == number;
        return isTry && (each.state == JournalState::Begun || each.state == JournalState::Unconfirmed);
    });
    if (isRegister(main, Known::Id) || isRegister(main, Known::BaudRate))
        return planMove(std::move(step), entry, table.get(), options);

    RevertPlan &plan = step.registers;
    plan.place = step.place;
    plan.firmware = entry.device.firmware;
    const Field *mode = table ? table->find(u"Drive Mode") : nullptr;
    if (mode && std::ranges::find(mode->bits, TorqueOnByGoalBit, &BitField::first) != mode->bits.end())
        plan.driveModeAddress = mode->address;
    for (const RegisterChange &change : entry.changes) {
        if (change.before.empty())
            continue;
        if (change.after.empty() && !putsBackUnknown(entries, entry, change, direction)) {
            std::erase_if(step.entry.changes,
                          [&](const RegisterChange &each) { return each.address == change.address; });
            continue;
        }
        plan.registers.push_back(revertRegister(change, direction, table.get()));
        if (hidesTorqueOn(plan.registers.back(), table.get()))
            return failure(ErrorKind::InvalidArgument, JournalText::tr("Entry %1 would switch torque on").arg(number));
        if (leadsNobodyKnowsWhere(plan.registers.back(), change, table.get()))
            return failure(
                ErrorKind::NotSupported,
                JournalText::tr("Entry %1 was written through indirect addresses: write its registers yourself")
                    .arg(number));
    }
    keepOthers(plan, main, table.get());
    const Field *level = table ? table->find(Known::StatusReturnLevel) : nullptr;
    plan.readsNothing = level && level->address == main.address && level->size == main.after.size()
                        && isRegister(main, Known::StatusReturnLevel) && plan.registers.front().from.front() == 0;
    if (plan.readsNothing) { // what the others hold isn't known, so nothing is written to them
        plan.kept.clear();
        plan.registers.resize(1);
    }
    plan.changedSince = direction == Direction::Undo ? changedSince(entries, entry, main) : 0;
    plan.goals = table ? spansOf(*table, step.place.id, isGoal) : std::vector<Span>();
    plan.mayMove = options.mayMove;
    plan.mayTurnTorqueOff = options.mayTurnTorqueOff;
    return step;
}

} // namespace dynascope
