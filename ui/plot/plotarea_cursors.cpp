// SPDX-License-Identifier: GPL-3.0-or-later
// The two cursors of all panels, and what is measured between them.
#include "ui/plot/plotarea.h"

#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"

namespace dynascope {

namespace {

constexpr std::size_t MeasuredAFrame = 60'000; ///< samples, about half a millisecond

} // namespace

void PlotArea::setCursorsOn(bool on)
{
    m_bar->setCursors(on);
    if (on == m_cursors.isOn)
        return;
    const TimeView view = m_present->chart().view();
    const LineTime third = (view.to() - view.from()) / 3;
    const auto isSeen = [&](LineTime at) { return view.zero + at >= view.from() && view.zero + at <= view.to(); };
    if (on && (!isSeen(m_cursors.at[0]) || !isSeen(m_cursors.at[1]) || m_cursors.distance() == LineTime(0)))
        m_cursors.at = {view.from() + third - view.zero, view.from() + 2 * third - view.zero};
    m_cursors.isOn = on;
    showCursors();
}

void PlotArea::moveCursor(int which, LineTime at)
{
    if (!m_cursors.isOn)
        setCursorsOn(true);
    m_cursors.at[static_cast<std::size_t>(which)] = at;
    m_cursors.active = which;
    showCursors();
}

void PlotArea::showCursors()
{
    for (PlotPanel *panel : m_panels)
        panel->setCursors(m_cursors);
}

/// A bounded part of it with each frame, until all is known.
void PlotArea::measure()
{
    for (PlotPanel *panel : m_panels) {
        std::size_t budget = MeasuredAFrame / m_panels.size(); // its own: a long stretch above leaves nobody waiting below
        panel->measure(m_cursors, budget);
    }
}

} // namespace dynascope
