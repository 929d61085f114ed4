// SPDX-License-Identifier: GPL-3.0-or-later
// Which time is shown: live, paused, or where the trigger puts it.
#include "ui/plot/plotarea.h"

#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::size_t DerivedAFrame = 100'000; ///< samples, about a millisecond

} // namespace

LineTime PlotArea::newest() const
{
    if (m_monitor.isRecorded())
        return m_session.now();
    LineTime newest{};
    for (const PlotPanel *panel : m_panels)
        newest = std::max(newest, panel->newest());
    return newest;
}

/// Up to where there is something to see: in a replay further than it has come.
LineTime PlotArea::last() const
{
    LineTime last = std::max(newest(), m_recordingEnd);
    for (const PlotPanel *panel : m_panels)
        last = std::max(last, panel->newest());
    return last;
}

void PlotArea::follow()
{
    const LineTime at = m_session.now();
    for (PlotPanel *panel : m_panels)
        panel->chart().setPlayhead(at);
    if (m_window.isLive())
        refreshAll();
}

void PlotArea::setRecording(LineTime begin, LineTime end)
{
    m_recordingEnd = end;
    m_window.setOrigin(begin); // a panel's own time begins as this one
}

void PlotArea::showTimes(LineTime from, LineTime to)
{
    m_window.setLive(); // so that pausing learns anew how far it goes
    for (PlotPanel *panel : m_panels)
        panel->ownTime().setLive();
    setLive(false);
    const LineTime margin = (to - from) / 200; // columns lie where they lie
    m_window.show(from - margin, to);
    for (PlotPanel *panel : m_panels)
        panel->ownTime().show(from - margin, to);
    showNewest();
}

TimeWindow &PlotArea::windowOf(PlotPanel *panel)
{
    return panel->hasOwnTime() ? panel->ownTime() : m_window;
}

void PlotArea::setLive(bool live)
{
    m_trigger->letGo();
    if (live) {
        m_window.setLive();
        for (PlotPanel *panel : m_panels)
            panel->ownTime().setLive();
    } else {
        const LineTime at = newest();
        const LineTime end = last();
        m_window.pause(at, end);
        for (PlotPanel *panel : m_panels)
            panel->ownTime().pause(at, end);
    }
    m_bar->setLive(live);
    for (PlotPanel *panel : m_panels)
        panel->setLive(live);
    refreshAll();
}

/// A bounded part with each frame, also while paused: what is added then is made for what is seen.
void PlotArea::derive()
{
    std::size_t budget = DerivedAFrame;
    for (PlotPanel *panel : m_panels) {
        const std::optional<LineTime> first = panel->model().derive(budget);
        if (first && !m_window.isLive() && *first <= windowOf(panel).pausedAt())
            panel->refreshTraces();
    }
}

void PlotArea::arm(const TriggerChoice &choice)
{
    m_trigger->arm(choice, newest());
}

void PlotArea::setTriggerOn(bool on)
{
    m_trigger->setOn(on, newest());
}

} // namespace dynascope
