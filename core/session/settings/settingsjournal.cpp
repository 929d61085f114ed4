// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/settingsjournal.h"

namespace dynascope {

SettingsHooks noted(Journal *journal, const JournalEntry &as, ControlTablePtr table, SettingsHooks others)
{
    const auto note = std::make_shared<JournalNote>(); // one write at a time
    SettingsHooks hooks;
    hooks.begun = [journal, as, table, note, begun = others.begun](const SettingsWrite &write) {
        JournalEntry entry = as;
        entry.changes = {{write.name, write.where.address, write.where.isSigned, write.before, write.to, {}}};
        const Field *field = table ? table->at(write.where.address) : nullptr;
        if (field && field->size == write.where.size) {
            addResets(entry, *table, *field, [&write](const Field &other) {
                return bytesIn(write.around, other.address, other.size);
            });
        }
        *note = JournalNote(journal, std::move(entry),
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

SettingsHooks posted(JobContext &context, SettingsHooks hooks)
{
    SettingsHooks there;
    there.begun = [&context, begun = hooks.begun](const SettingsWrite &write) {
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
