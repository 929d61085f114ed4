// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/noting.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

JournalEntry entryOf(const Work &work, const Device &device)
{
    JournalEntry entry;
    entry.by = JournalAuthor::CommandLine;
    entry.device = journalDevice(device.found(), device.model(), work.options.port);
    return entry;
}

} // namespace

std::vector<const Field *> affectedBy(Device &device, const Field &field)
{
    const ControlTable *table = device.table();
    if (!table || table->indexOf(&field) < 0) // given by its address
        return {};
    const Field *mode = isGoal(field) ? table->find(u"Drive Mode") : nullptr;
    bool byGoal = false;
    if (mode && std::ranges::any_of(mode->bits, [](const BitField &bit) { return bit.first == TorqueOnByGoalBit; })) {
        const auto raw = device.isMute() ? Result<std::int64_t>(0) : device.read(*mode);
        byGoal = !raw || ((*raw >> TorqueOnByGoalBit) & 1) != 0;
    }
    return affectedBy(*table, field, byGoal);
}

JournalNote noteWrite(const Work &work, const Device &device, std::vector<RegisterChange> changes,
                      const std::vector<const Field *> &affected)
{
    JournalEntry entry = entryOf(work, device);
    entry.changes = std::move(changes);
    return {&work.journal, std::move(entry), affected};
}

JournalNote noteEvent(const Work &work, const Device &device, JournalKind kind, const QString &what)
{
    JournalEntry entry = entryOf(work, device);
    entry.kind = kind;
    entry.note = what;
    return {&work.journal, std::move(entry)};
}

void finish(JournalNote &note, const Result<void> &outcome)
{
    if (outcome)
        note.done();
    else
        note.failed(outcome.error());
}

} // namespace dynascope::dxl
