// SPDX-License-Identifier: GPL-3.0-or-later
// Which time is shown: live, paused, or where the trigger puts it.
#include "ui/plot/plotarea.h"

#include "ui/common/present.h"
#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"
#include "ui/plot/triggerdialog.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::size_t LookedAtAFrame = 100'000; ///< samples, about a millisecond

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
    m_isHeld = false;
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
    std::size_t budget = LookedAtAFrame;
    for (PlotPanel *panel : m_panels) {
        const std::optional<LineTime> first = panel->model().derive(budget);
        if (first && !m_window.isLive() && *first <= windowOf(panel).pausedAt())
            panel->refreshTraces();
    }
}

PlotPanel *PlotArea::triggeringPanel() const
{
    const auto at = std::ranges::find_if(m_panels, [this](const PlotPanel *panel) {
        return panel->model().indexOf(m_trigger->choice().trace) >= 0;
    });
    return at == m_panels.end() ? nullptr : *at;
}

void PlotArea::askForTrigger()
{
    const QString name = QStringLiteral("triggerDialog");
    if (raiseOpen(*window(), name))
        return;
    std::vector<TriggerDialog::Source> sources;
    for (const PlotPanel *panel : m_panels) {
        const TraceModel &model = panel->model();
        for (int row = 0; row < model.rowCount(); ++row) {
            const TraceModel::Linear scale = model.scaleOf(row);
            const History *history = model.history(row);
            const auto newest = history ? m_monitor.newest(*history) : std::nullopt;
            const double raw = newest ? newest->raw : 0;
            sources.push_back({model.key(row), model.index(row).data().toString(), scale.unit, scale.decimals,
                raw * scale.scale + scale.offset});
        }
    }
    auto *dialog = new TriggerDialog(m_trigger->choice(), std::move(sources), this);
    connect(dialog, &TriggerDialog::chosen, this, &PlotArea::arm);
    present(*dialog);
}

void PlotArea::arm(const TriggerChoice &choice)
{
    m_trigger->choose(choice);
    setTriggerOn(true);
}

void PlotArea::setTriggerOn(bool on)
{
    const bool isEvent = m_trigger->choice().settings.kind == TriggerSettings::Kind::Event;
    if (on && !isEvent && !triggeringPanel()) {
        m_bar->setTrigger(false); // until somebody has said by what
        return askForTrigger();
    }
    m_trigger->setOn(on, newest());
    if (on || m_isHeld)
        setLive(true);
    showTrigger();
}

void PlotArea::standStill()
{
    m_isHeld = false;
}

/// What a person paused isn't moved by it.
void PlotArea::lookAtTrigger()
{
    if (!m_trigger->isOn() || (!m_window.isLive() && !m_isHeld))
        return;
    const PlotPanel *panel = triggeringPanel();
    const TraceModel *model = panel ? &panel->model() : nullptr;
    const History *history = model ? model->history(model->indexOf(m_trigger->choice().trace)) : nullptr;
    std::size_t budget = LookedAtAFrame;
    const LineTime now = newest();
    if (m_trigger->advance(model, history, now, budget)) {
        if (const std::optional<LineTime> at = m_trigger->shown()) {
            const TriggerSettings &settings = m_trigger->choice().settings;
            m_window.hold(*at, settings.before, settings.after, now);
            for (PlotPanel *each : m_panels) {
                each->ownTime().hold(*at, settings.before, settings.after, now);
                each->setLive(false);
            }
            m_isHeld = true;
            m_bar->setLive(false);
            refreshAll();
        } else {
            setLive(true);
        }
    }
    showTrigger();
}

/// The level where its trace is; the words there, too, or in the first panel.
void PlotArea::showTrigger()
{
    m_bar->setTrigger(m_trigger->isOn() && !m_trigger->isDone());
    const PlotPanel *of = triggeringPanel();
    TriggerMark mark = m_trigger->mark(of ? &of->model() : nullptr);
    mark.isShown = mark.isShown && m_isHeld;
    for (PlotPanel *panel : m_panels) {
        TriggerMark its = mark;
        if (panel != (of ? of : m_panels.front())) {
            its.hasLevel = false;
            its.text.clear();
        }
        panel->chart().setTrigger(its);
    }
}

} // namespace dynascope
