// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of all programs of this project: listed, undone, redone, written as a script.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "app/dxl/interrupt.h"
#include "core/session/journal/journalnote.h"
#include "core/session/journal/journaltexts.h"
#include "core/session/journal/undosequence.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

struct JournalWork {
    const Catalog &catalog;
    const Options &options;
    Output &output;
    Journal &journal;
};

bool isNamed(const JournalOptions &options, qint64 number)
{
    return std::ranges::any_of(options.ranges, [number](const JournalOptions::Range &range) {
        return number >= range.from && number <= range.to;
    });
}

std::vector<JournalEntry> wanted(const JournalWork &work)
{
    const JournalOptions &options = work.options.journal;
    std::vector<JournalEntry> entries;
    for (const JournalEntry &entry : work.journal.entries()) {
        if (options.ranges.empty() || isNamed(options, entry.number))
            entries.push_back(entry);
    }
    return entries;
}

Document changeDocument(const RegisterChange &change)
{
    Document document;
    if (!change.name.isEmpty())
        document.add("register", change.name);
    document.add("address", qint64(change.address)).add("length", qint64(lengthOf(change)));
    if (!change.before.empty())
        document.add("old", bytesText(change.before, change.isSigned));
    document.add("new", bytesText(change.after, change.isSigned));
    if (!change.shown.empty())
        document.add("read", bytesText(change.shown, change.isSigned));
    return document;
}

Document documentOf(const JournalEntry &entry, bool isUndone)
{
    Document document;
    document.add("entry", entry.number)
        .add("time", entry.at.toString(Qt::ISODateWithMs))
        .add("by", wordOf(entry.by))
        .add("what", wordOf(entry.kind))
        .add("state", wordOf(entry.state))
        .addFlag("undone", isUndone)
        .add("port", entry.device.line)
        .add("baud", qint64(entry.device.baudRate))
        .add("id", qint64(entry.device.id))
        .add("model", entry.device.model);
    std::vector<Document> changes;
    for (const RegisterChange &change : entry.changes)
        changes.push_back(changeDocument(change));
    document.add("changes", changes);
    if (entry.undoes > 0)
        document.add("undoes", entry.undoes);
    if (entry.redoes > 0)
        document.add("redoes", entry.redoes);
    if (!entry.note.isEmpty())
        document.add("note", entry.note);
    return document;
}

QString stateText(const JournalEntry &entry, bool isUndone)
{
    const QString failed = entry.state == JournalState::Done ? QString() : QStringLiteral(", ") + wordOf(entry.state);
    if (entry.undoes > 0)
        return QStringLiteral("undo of %1").arg(entry.undoes) + failed;
    if (entry.redoes > 0)
        return QStringLiteral("redo of %1").arg(entry.redoes) + failed;
    return isUndone ? QStringLiteral("undone") : entry.state == JournalState::Done ? QString() : wordOf(entry.state);
}

ExitCode list(const JournalWork &work)
{
    std::vector<JournalEntry> entries = wanted(work);
    const auto count = static_cast<std::size_t>(work.options.journal.count);
    if (work.options.journal.ranges.empty() && entries.size() > count)
        entries.erase(entries.begin(), entries.end() - static_cast<std::ptrdiff_t>(count));
    const std::set<qint64> undone = undoneEntries(work.journal.entries());
    work.output.expectMany();
    if (entries.empty())
        work.output.note(QStringLiteral("the journal has no such entries"));
    if (work.options.json) {
        for (const JournalEntry &entry : entries)
            work.output.result({}, documentOf(entry, undone.contains(entry.number)));
        return ExitCode::Done;
    }
    std::vector<QStringList> rows;
    for (const JournalEntry &entry : entries) {
        rows.push_back({QString::number(entry.number),
                        entry.at.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")), wordOf(entry.by),
                        deviceText(entry.device), whatText(entry), changeText(work.catalog, entry),
                        stateText(entry, undone.contains(entry.number))});
    }
    if (!rows.empty())
        work.output.result(aligned(rows, {1, 2, 3, 4, 5, 6}), Document());
    return ExitCode::Done;
}

ExitCode exportScript(const JournalWork &work)
{
    const std::vector<JournalEntry> entries = wanted(work);
    Document document;
    const QString script = scriptOf(entries);
    document.add("script", script);
    work.output.result(script.chopped(1), document);
    return ExitCode::Done;
}

/// Of a range those that can be; of one named by itself why it can't.
Result<std::vector<qint64>> chosen(const JournalWork &work, Direction direction)
{
    const JournalOptions &options = work.options.journal;
    const JournalEntries &entries = work.journal.entries();
    const std::set<qint64> undone = undoneEntries(entries);
    std::vector<qint64> numbers;
    if (options.last) {
        const qint64 next = direction == Direction::Undo ? nextToUndo(entries) : nextToRedo(entries);
        if (next == 0)
            return failure(
                ErrorKind::InvalidArgument,
                QStringLiteral("nothing is left to %1").arg(direction == Direction::Undo ? u"undo" : u"redo"));
        numbers.push_back(next);
    }
    for (const JournalOptions::Range &range : options.ranges) {
        if (range.isOne) {
            if (const QString why = whyNot(entries, undone, range.from, direction); !why.isEmpty())
                return failure(ErrorKind::InvalidArgument, why);
            numbers.push_back(range.from);
            continue;
        }
        for (const JournalEntry &entry : entries) {
            if (entry.number >= range.from && entry.number <= range.to
                && whyNot(entries, undone, entry.number, direction).isEmpty())
                numbers.push_back(entry.number);
        }
    }
    if (numbers.empty())
        return failure(ErrorKind::InvalidArgument, QStringLiteral("none of these entries can be undone or redone"));
    return numbers;
}

Document stepDocument(const UndoStep &step, const JournalEntry &outcome)
{
    Document document;
    document.add(step.direction == Direction::Undo ? "undone" : "redone", step.number)
        .add("id", qint64(step.place.id))
        .add("baud", qint64(step.place.baudRate))
        .add("model", step.entry.device.model);
    std::vector<Document> changes;
    for (const RegisterChange &change : outcome.changes)
        changes.push_back(changeDocument(change));
    document.add("changes", changes);
    if (!outcome.note.isEmpty())
        document.add("note", outcome.note);
    return document;
}

void show(const JournalWork &work, const UndoStep &step, const JournalEntry &outcome)
{
    const QString what =
        QStringLiteral("%1 %2: %3, %4: %5%6")
            .arg(step.direction == Direction::Undo ? QStringLiteral("undo of") : QStringLiteral("redo of"),
                 QString::number(step.number), step.place.name, whatText(step.entry),
                 changeText(work.catalog, step.entry),
                 outcome.note.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(outcome.note));
    work.output.result(what, stepDocument(step, outcome));
}

/// Without asking a device.
ExitCode describe(const JournalWork &work, std::vector<qint64> numbers, Direction direction)
{
    UndoSequence sequence(std::move(numbers), direction, {true, true});
    JournalEntries entries = work.journal.entries();
    while (auto step = sequence.next(entries, work.catalog)) {
        show(work, *step, step->entry);
        // Later ones are planned as if it had been done.
        JournalEntry done = step->entry;
        done.number = entries.back().number + 1;
        done.state = JournalState::Done;
        UndoResult result;
        if (step->newId)
            result.moved = Found{step->newId->newId, step->place.baudRate, 0, 0, false, {}};
        if (step->newBaud)
            result.moved = Found{step->place.id, step->newBaud->newBaudRate, 0, 0, false, {}};
        if (result.moved)
            done.movedTo = JournalPlace{result.moved->id, result.moved->baudRate};
        entries.push_back(done);
        sequence.take(*step, result);
    }
    return sequence.outcome() ? ExitCode::Done : work.output.refuse(sequence.outcome().error());
}

ExitCode perform(const JournalWork &work, Bus &bus, std::vector<qint64> numbers, Direction direction)
{
    const JournalOptions &options = work.options.journal;
    UndoSequence sequence(std::move(numbers), direction, {options.mayMove, options.mayTurnTorqueOff});
    const JournalDevice here = journalDevice(Found{}, {}, work.options.port);
    DirectJob job(bus);
    while (auto step = sequence.next(work.journal.entries(), work.catalog)) {
        if (!isSameLine(here, step->entry.device)) {
            sequence.fail({ErrorKind::InvalidArgument, QStringLiteral("entry %1 is of %2 on %3, not on %4")
                                                           .arg(QString::number(step->number), step->place.name,
                                                                step->entry.device.line, work.options.port)});
            break;
        }
        step->entry.device.line = work.options.port;
        JournalNote note(&work.journal, step->entry);
        const auto result = carryOut(job, *step);
        const JournalEntry outcome = outcomeOf(*step, result);
        note.finish(outcome);
        if (result && result->registers.missing == Consent::None)
            show(work, *step, outcome);
        sequence.take(*step, result);
    }
    if (sequence.outcome())
        return ExitCode::Done;
    Error error = sequence.outcome().error();
    if (sequence.missing() == Consent::Motion)
        error.text += QStringLiteral("; --move allows it");
    if (sequence.missing() == Consent::TorqueOff)
        error.text += QStringLiteral("; --torque-off allows it");
    return work.output.fail(error);
}

} // namespace

ExitCode journalCommand(const Catalog &catalog, Options options, Output &output)
{
    heedSignals();
    Journal journal(Journal::usualFolder());
    QObject::connect(&journal, &Journal::failed, [&output](const QString &why) { output.note(why); });
    const JournalWork work{catalog, options, output, journal};
    if (options.journal.action == JournalAction::List)
        return list(work);
    if (options.journal.action == JournalAction::Export)
        return exportScript(work);
    const Direction direction = options.journal.action == JournalAction::Undo ? Direction::Undo : Direction::Redo;
    auto numbers = chosen(work, direction);
    if (!numbers)
        return output.refuse(numbers.error());
    output.expectMany();
    if (options.journal.dryRun)
        return describe(work, std::move(*numbers), direction);
    if (options.port.isEmpty()) // where they were written
        options.port = journal.entry(numbers->front())->device.line;
    const auto connection = Connection::open(catalog, options);
    if (!connection)
        return output.fail(connection.error());
    return perform(work, (*connection)->bus(), std::move(*numbers), direction);
}

} // namespace dynascope::dxl
