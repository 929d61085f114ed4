// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionjournal.h"

namespace dynascope {
namespace {

JournalEntry entryOf(JournalAuthor by, const QString &line, const Catalog &catalog, const CommissionWrite &write)
{
    JournalEntry entry;
    entry.by = by;
    entry.device = journalDevice(write.who, modelName(catalog, write.who.modelNumber), line);
    entry.changes = {write.change};
    entry.ahead = write.ahead;
    return entry;
}

} // namespace

CommissionHooks noted(Journal *journal, JournalAuthor by, const QString &line, const Catalog &catalog,
                      CommissionHooks others)
{
    const auto note = std::make_shared<JournalNote>(); // one write at a time
    CommissionHooks hooks = others;
    hooks.begun = [journal, by, line, &catalog, note, begun = others.begun](const CommissionWrite &write) {
        const ControlTablePtr table = catalog.find(write.who.modelNumber, write.who.firmware);
        const Field *field = table ? table->at(write.change.address) : nullptr;
        *note = JournalNote(journal, entryOf(by, line, catalog, write),
                            field ? affectedBy(*table, *field, true) : std::vector<const Field *>());
        if (begun)
            begun(write);
    };
    hooks.ended = [note, ended = others.ended](const CommissionWrite &write, const CommissionWritten &outcome) {
        if (outcome.error)
            note->failed(*outcome.error, outcome.before);
        else if (outcome.movedTo)
            note->moved(*outcome.movedTo);
        else
            note->done(outcome.before, outcome.after);
        if (ended)
            ended(write, outcome);
    };
    return hooks;
}

CommissionHooks notedAhead(Journal *journal, JournalAuthor by, const QString &line, const Catalog &catalog,
                           CommissionHooks others)
{
    CommissionHooks hooks = noted(journal, by, line, catalog, std::move(others));
    if (auto ahead = journal ? journal->ahead() : nullptr) {
        hooks.ahead = [ahead, by, line, &catalog](const CommissionWrite &write) {
            return ahead->append(entryOf(by, line, catalog, write));
        };
        // Held until the journal has heard of the last one.
        hooks.begun = [ahead, begun = hooks.begun](const CommissionWrite &write) { begun(write); };
    }
    return hooks;
}

CommissionHooks posted(JobContext &context, CommissionHooks hooks)
{
    CommissionHooks there;
    there.looking = [&context, looking = hooks.looking](int baudRate) {
        if (looking)
            context.post([looking, baudRate] { looking(baudRate); });
    };
    there.found = [&context, found = hooks.found](const Found &device, std::size_t joint) {
        if (found)
            context.post([found, device, joint] { found(device, joint); });
    };
    there.begun = [&context, begun = hooks.begun, ahead = hooks.ahead](CommissionWrite write) {
        if (ahead)
            write.ahead = ahead(write);
        if (begun)
            context.post([begun, write] { begun(write); });
    };
    there.ended = [&context, ended = hooks.ended](const CommissionWrite &write, const CommissionWritten &outcome) {
        if (ended)
            context.post([ended, write, outcome] { ended(write, outcome); });
    };
    return there;
}

} // namespace dynascope
