// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionjournal.h"

namespace dynascope {

CommissionHooks noted(Journal *journal, JournalAuthor by, const QString &line, const Catalog &catalog,
                      CommissionHooks others)
{
    const auto note = std::make_shared<JournalNote>(); // one write at a time
    CommissionHooks hooks = others;
    hooks.begun = [journal, by, line, &catalog, note, begun = others.begun](const CommissionWrite &write) {
        JournalEntry entry;
        entry.by = by;
        entry.device = journalDevice(write.who, modelName(catalog, write.who.modelNumber), line);
        entry.changes = {write.change};
        const ControlTablePtr table = catalog.find(write.who.modelNumber, write.who.firmware);
        const Field *field = table ? table->at(write.change.address) : nullptr;
        *note = JournalNote(journal, std::move(entry),
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
    there.begun = [&context, begun = hooks.begun](const CommissionWrite &write) {
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
