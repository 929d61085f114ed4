// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/areatrigger.h"

#include "ui/common/present.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"
#include "ui/plot/triggerdialog.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::size_t SearchedAFrame = 100'000; ///< samples, about a millisecond

} // namespace

AreaTrigger::AreaTrigger(
    EventLog &log, Monitor &monitor, const std::vector<PlotPanel *> &panels, TimeWindow &window, QWidget &area)
    : m_monitor(monitor)
    , m_panels(panels)
    , m_window(window)
    , m_area(area)
    , m_trigger(log)
{
}

PlotPanel *AreaTrigger::panel() const
{
    const auto at = std::ranges::find_if(m_panels,
        [this](const PlotPanel *panel) { return panel->model().indexOf(m_trigger.choice().trace) >= 0; });
    return at == m_panels.end() ? nullptr : *at;
}

void AreaTrigger::arm(const TriggerChoice &choice, LineTime now)
{
    m_trigger.choose(choice);
    setOn(true, now);
}

void AreaTrigger::setOn(bool on, LineTime now)
{
    const bool isEvent = m_trigger.choice().settings.kind == TriggerSettings::Kind::Event;
    if (on && !isEvent && !panel()) {
        emit armedChanged(false); // until somebody has said by what
        return ask();
    }
    m_trigger.setOn(on, now);
    if (on || m_isHeld)
        emit liveRequested();
    show();
}

void AreaTrigger::ask()
{
    if (raiseOpen(*m_area.window(), QStringLiteral("triggerDialog")))
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
    auto *dialog = new TriggerDialog(m_trigger.choice(), std::move(sources), &m_area);
    connect(dialog, &TriggerDialog::chosen, this, &AreaTrigger::chosen);
    present(*dialog);
}

void AreaTrigger::look(LineTime now)
{
    const PlotPanel *of = panel();
    const TraceModel *model = of ? &of->model() : nullptr;
    const History *history = model ? model->history(model->indexOf(m_trigger.choice().trace)) : nullptr;
    std::size_t budget = SearchedAFrame;
    if (m_trigger.advance(model, history, now, budget)) {
        if (const std::optional<LineTime> at = m_trigger.shown())
            stand(*at, now);
        else
            emit liveRequested();
    }
    show();
}

void AreaTrigger::stand(LineTime at, LineTime now)
{
    const TriggerSettings &settings = m_trigger.choice().settings;
    m_window.hold(at, settings.before, settings.after, now);
    for (PlotPanel *each : m_panels) {
        each->ownTime().hold(at, settings.before, settings.after, now);
        each->setLive(false);
    }
    m_isHeld = true;
    emit stood();
}

/// The level where its trace is; the words there, too, or in the first panel.
void AreaTrigger::show()
{
    emit armedChanged(m_trigger.isOn() && !m_trigger.isDone());
    const PlotPanel *of = panel();
    TriggerMark mark = m_trigger.mark(of ? &of->model() : nullptr);
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

PlotState::TriggerState AreaTrigger::state(const Session &session) const
{
    const TriggerChoice &choice = m_trigger.choice();
    PlotState::TriggerState state{
        PlotState::Trace::of(choice.trace, session), choice.level, choice.hysteresis, choice.settings};
    if (!state.trace)
        state.trace = m_waiting;
    return state;
}

void AreaTrigger::restore(const PlotState::TriggerState &state)
{
    m_trigger.choose({{}, state.level, state.hysteresis, state.settings});
    m_waiting = state.trace;
}

void AreaTrigger::findTrace(const std::vector<Device *> &devices)
{
    const std::optional<TraceKey> key = m_waiting ? m_waiting->find(devices) : std::nullopt;
    if (!key)
        return;
    TriggerChoice choice = m_trigger.choice();
    choice.trace = *key;
    m_trigger.choose(choice);
    m_waiting.reset();
}

} // namespace dynascope
