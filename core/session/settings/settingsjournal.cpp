// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/settingsjournal.h"

namespace dynascope {
namespace {

const Field *fieldOf(const ControlTablePtr &table, const SettingsWrite &write)
{
    return table ? table->at(write.where.address) : nullptr;
}

JournalEntry entryOf(const JournalEntry &as, const ControlTablePtr &table, const SettingsWrite &write)
{
    JournalEntry entry = as;
    entry.ahead = write.ahead;
    entry.changes = {{write.name, write.where.address, write.where.isSigned, write.before, write.to, {}}};
    const Field *field = fieldOf(table, write);
    if (field && field->size == write.where.size) {
        addResets(entry, *table, *field,
                  [&write](const Field &other) { return bytesIn(write.around, other.address, other.size); });
    }
    return entry;
}

} // namespace

SettingsHooks noted(Journal *journal, const JournalEntry &as, ControlTablePtr table, SettingsHooks others)
{
    const auto note = std::make_shared<JournalNote>(); // one write at a time
    SettingsHooks hooks;
    hooks.begun = [journal, as, table, note, begun = others.begun](const SettingsWrite &write) {
        const Field *field = fieldOf(table, write);
        *note = JournalNote(journal, entryOf(as, table, write),
                            field ? affectedBy(*table, *field, true) : std::vector<const Field *>());
        if (begun)
            begun(write);
    };
    hooks.ended = [note, ended = others.ended](const SettingsWrite &write, std::span<const PollValue> before,
                                               const Result<std::vector<PollValue>> &after) {
        if (after)
            note->done(before, *after);
        else
            note->failed(after.error(), before);
        if (ended)
            ended(write, before, after);
    };
    return hooks;
}

SettingsHooks notedAhead(Journal *journal, const JournalEntry &as, ControlTablePtr table, SettingsHooks others)
{
    SettingsHooks hooks = noted(journal, as, table, std::move(others));
    if (auto ahead = journal ? journal->ahead() : nullptr) {
        hooks.ahead = [ahead, as, table](const SettingsWrite &write) {
            return ahead->append(entryOf(as, table, write));
        };
        // Held until the journal has heard of the last one.
        hooks.begun = [ahead, begun = hooks.begun](const SettingsWrite &write) { begun(write); };
    }
    return hooks;
}

SettingsHooks posted(JobContext &context, SettingsHooks hooks)
{
    SettingsHooks there;
    there.begun = [&context, begun = hooks.begun, ahead = hooks.ahead](SettingsWrite write) {
        if (ahead)
            write.ahead = ahead(write);
        if (begun)
            context.post([begun, write] { begun(write); });
    };
    there.ended = [&context, ended = hooks.ended](const SettingsWrite &write, std::span<const PollValue> before,
                                                  const Result<std::vector<PollValue>> &after) {
        if (!ended)
            return;
        context.post([ended, write, old = std::vector<PollValue>(before.begin(), before.end()), after] {
            ended(write, old, after);
        });
    };
    return there;
}

} // namespace dynascope
