// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalnote.h"
#include "core/session/settings/applysettings.h"

namespace dynascope {

/// Hooks that put each write into the journal, then call `others`. `as`: by whom and to whom, without changes. On the
/// journal's thread; `journal` may be null.
SettingsHooks noted(Journal *journal, const JournalEntry &as, ControlTablePtr table, SettingsHooks others = {});

/// The same, for posted(): the bus thread notes each write itself before it goes out (JournalAhead).
SettingsHooks notedAhead(Journal *journal, const JournalEntry &as, ControlTablePtr table, SettingsHooks others = {});

/// Hooks for the bus thread that have `hooks` called on the GUI thread, in their order, while the job's context object
/// lives. For one run of `context`.
SettingsHooks posted(JobContext &context, SettingsHooks hooks);

} // namespace dynascope
