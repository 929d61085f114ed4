// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/plotstate.h"

#include <map>

namespace dynascope {

/// Which colour each trace has: that of a device's field stays with it in every panel, when it is shown again, and from
/// one start to the next. GUI thread.
class TraceColors
{
public:
    explicit TraceColors(const Session &session) : m_session(session) { }

    /// The colour it had, unless another that is shown has it now; else the first that nothing shown has, rather one that
    /// nothing is remembered to have had.
    int take(const TraceKey &key);
    void release(const TraceKey &key); ///< it is no longer shown; to be called once for each take()
    void remember(const TraceKey &key, int color);

    /// Names with `color`, the latest last; for PlotState.
    const std::vector<PlotState::Trace> &remembered() const { return m_remembered; }
    void restore(const std::vector<PlotState::Trace> &remembered);

    static constexpr std::size_t Most = 256;

private:
    PlotState::Trace *find(const TraceKey &key);
    bool isShownByAnother(int color, const TraceKey &key) const;

    struct Shown {
        TraceKey key;
        int color = 0;
        int count = 0; ///< in so many panels
    };
    const Session &m_session;
    std::vector<Shown> m_shown;
    std::vector<PlotState::Trace> m_remembered;
};

/// Lines beyond the eighth have patterns as well, so that they are told apart where colours aren't: 0 solid, then
/// dashes, dots, dashes and dots.
int dashOf(int color);
/// Is there ink in this pixel column? Counted from the clock's zero, so that the pattern moves with the line.
bool traceInk(int dash, std::int64_t column, int pixelRatio);

} // namespace dynascope
