// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

enum class JournalAction { List, Undo, Redo, Export };

/// What `dxl journal` was told.
struct JournalOptions {
    /// Numbers from and to, both included.
    struct Range {
        qint64 from = 0, to = 0;
        bool isOne = false; ///< named by itself: refused where it can't be
    };
    JournalAction action = JournalAction::List;
    std::vector<Range> ranges; ///< none: what the action does without
    bool last = false;         ///< the one that is next
    int count = 20;            ///< list: at most, the newest
    bool mayMove = false, mayTurnTorqueOff = false;
    bool dryRun = false;
};

/// The part of the command line that is `dxl journal`.
class JournalArguments
{
public:
    JournalArguments();
    ~JournalArguments();
    void describe(CLI::App &app);
    Result<JournalOptions> understand() const; ///< what was parsed

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
