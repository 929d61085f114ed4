// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journal.h"
#include "core/session/journal/journalwrites.h"

namespace dynascope {

/// One write on its way into the journal: noted when it is begun, completed by one of the ends below. A value that
/// callbacks may copy. Without a journal, or default made, it does nothing.
class JournalNote
{
public:
    JournalNote() = default;
    /// `affected` may change with the write. `journal` outlives the note; may be null.
    JournalNote(Journal *journal, JournalEntry entry, const std::vector<const Field *> &affected = {});

    bool isKept() const { return m_journal != nullptr; }
    qint64 number() const { return m_number; }

    /// Read back, with what was read before; without that the old values are those given at the beginning.
    void done(std::span<const PollValue> before, std::span<const PollValue> after);
    void done(); ///< nothing to be read back
    void failed(const Error &error, std::span<const PollValue> before = {});
    void moved(const Found &found); ///< the device now answers there
    /// Anything else, in one piece: state, changes, movedTo, note.
    void finish(const JournalEntry &outcome);
    const JournalEntry &entry() const { return m_entry; } ///< as it was begun

private:
    Journal *m_journal = nullptr;
    qint64 m_number = 0;
    JournalEntry m_entry;
    JournalEntry asKnown() const;
    std::vector<RegisterChange> m_affected;
};

} // namespace dynascope
