// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalnote.h"

#include "core/bus/scan.h"

namespace dynascope {

JournalNote::JournalNote(Journal *journal, JournalEntry entry, const std::vector<const Field *> &affected)
    : m_journal(journal), m_entry(std::move(entry))
{
    if (!m_journal)
        return;
    for (const Field *field : affected)
        m_affected.push_back(changeOf(*field, Bytes(field->size)));
    m_number = m_journal->begin(m_entry);
}

void JournalNote::finish(const JournalEntry &outcome)
{
    if (m_journal)
        m_journal->finish(m_number, outcome);
}

/// Without what the write might have reset, now that it is known whether it has.
JournalEntry JournalNote::asKnown() const
{
    JournalEntry outcome = m_entry;
    std::erase_if(outcome.changes, [](const RegisterChange &change) { return change.after.empty(); });
    return outcome;
}

void JournalNote::done(std::span<const PollValue> before, std::span<const PollValue> after)
{
    JournalEntry outcome = asKnown();
    outcome.state = JournalState::Done;
    if (!outcome.changes.empty())
        takeReadings(outcome, m_affected, before, after);
    finish(outcome);
}

void JournalNote::done()
{
    JournalEntry outcome = asKnown();
    outcome.state = JournalState::Done;
    finish(outcome);
}

void JournalNote::failed(const Error &error, std::span<const PollValue> before)
{
    JournalEntry outcome = stateAfter(error) == JournalState::Failed ? asKnown() : m_entry;
    outcome.state = stateAfter(error);
    outcome.note = error.text;
    if (!outcome.changes.empty())
        takeReadings(outcome, {}, before, {});
    for (RegisterChange &change : outcome.changes) {
        if (Bytes old = bytesIn(before, change.address, lengthOf(change)); change.after.empty() && !old.empty())
            change.before = std::move(old);
    }
    finish(outcome);
}

void JournalNote::moved(const Found &found)
{
    JournalEntry outcome = m_entry;
    outcome.state = JournalState::Done;
    outcome.movedTo = JournalPlace{found.id, found.baudRate};
    if (!outcome.changes.empty())
        outcome.changes.front().shown = outcome.changes.front().after; // it answers there: that is what they say
    finish(outcome);
}

} // namespace dynascope
