// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commissioning/commissionround.h"
#include "core/session/journal/journalnote.h"

namespace dynascope {

/// Hooks that put each write into the journal, then call `others`. On the journal's thread; `journal` may be null,
/// `catalog` outlives the hooks. `line`, as the person named it.
CommissionHooks noted(Journal *journal, JournalAuthor by, const QString &line, const Catalog &catalog,
                      CommissionHooks others = {});

/// The same, for posted(): the bus thread notes each write itself before it goes out (JournalAhead).
CommissionHooks notedAhead(Journal *journal, JournalAuthor by, const QString &line, const Catalog &catalog,
                           CommissionHooks others = {});

/// Hooks for the bus thread that have `hooks` called on the GUI thread, in their order, while the job's context object
/// lives. For one run of `context`.
CommissionHooks posted(JobContext &context, CommissionHooks hooks);

} // namespace dynascope
