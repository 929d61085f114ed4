// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undo.h"

#include <utility>

namespace dynascope {

Undo::Undo(Session &session, Commands &commands, QObject *parent)
    : QObject(parent), m_session(session), m_commands(commands)
{
    Q_ASSERT(commands.journal());
}

qint64 Undo::nextToUndo() const
{
    const Journal &journal = *m_commands.journal();
    return dynascope::nextToUndo(journal.entries(), journal.run());
}

qint64 Undo::nextToRedo() const
{
    const Journal &journal = *m_commands.journal();
    return dynascope::nextToRedo(journal.entries(), journal.run());
}

void Undo::run(std::vector<qint64> numbers, Direction direction, const UndoOptions &options, Done done)
{
    if (m_busy) {
        if (done)
            done(failure(ErrorKind::Cancelled, tr("Another undo is running")));
        return;
    }
    m_commands.journal()->refresh(); // another program may have undone some of it
    m_sequence = UndoSequence(std::move(numbers), direction, options);
    m_done = std::move(done);
    m_busy = true;
    emit busyChanged();
    next();
}

void Undo::next()
{
    if (m_commands.isStopped())
        m_sequence.fail({ErrorKind::Stopped, tr("STOP is held: release it before anything is undone")});
    auto step = m_sequence.next(m_commands.journal()->entries(), m_session.catalog());
    if (step)
        carryOut(std::move(*step));
    else
        end();
}

LineSession *Undo::lineOf(const JournalEntry &entry) const
{
    for (const auto &line : m_session.lines()) {
        const JournalDevice here = journalDevice(Found{}, {}, line->name());
        const bool isThere = line->state() == BusThread::State::Open || line->state() == BusThread::State::Opening;
        if (isThere && isSameLine(here, entry.device))
            return line.get();
    }
    return nullptr;
}

void Undo::carryOut(UndoStep step)
{
    LineSession *line = lineOf(step.entry);
    if (!line) {
        m_sequence.fail(
            {ErrorKind::NotFound, tr("Entry %1 is of %2 on %3, which is not connected")
                                      .arg(QString::number(step.number), step.place.name, step.entry.device.line)});
        return end();
    }
    step.entry.device.line = line->name();
    const JournalNote note(m_commands.journal(), step.entry);
    line->bus().run<UndoResult>(
        Priority::Click, this, [step](JobContext &context) { return dynascope::carryOut(context, step); },
        [this, step, note](const Result<UndoResult> &result) { take(step, note, result); });
}

void Undo::take(const UndoStep &step, JournalNote note, const Result<UndoResult> &result)
{
    note.finish(outcomeOf(step, result));
    m_sequence.take(step, result);
    if (result && result->registers.missing == Consent::None)
        update(step, *result);
    next();
}

/// The screen shows what the servo said.
void Undo::update(const UndoStep &step, const UndoResult &result)
{
    LineSession *line = lineOf(step.entry);
    Device *device = line ? line->deviceAt(step.place.id, step.place.baudRate) : nullptr;
    if (!device)
        return;
    if (result.moved) {
        line->moveDevice(*device, *result.moved);
        m_commands.readAll(*device);
        return;
    }
    line->answered(*device);
    for (const PollValue &value : result.registers.after)
        device->take(value);
    const int torque = device->table().indexOf(Known::TorqueEnable);
    if (result.registers.torqueTurnedOff && torque >= 0)
        device->takeReadBack(torque, 0);
}

void Undo::end()
{
    const Result<void> result = m_sequence.outcome();
    m_busy = false;
    emit busyChanged();
    emit finished(m_sequence.carriedOut(), result ? QString() : result.error().text);
    if (const Done done = std::exchange(m_done, nullptr))
        done(result);
}

} // namespace dynascope
