// SPDX-License-Identifier: GPL-3.0-or-later
// What is remembered of the plots from one start to the next.
#include "ui/plot/plotarea.h"

#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"

#include <algorithm>

namespace dynascope {

QByteArray PlotArea::saveState() const
{
    PlotState state;
    state.spanSeconds = m_bar->span();
    state.autoscale = m_panels.front()->chart().isAutoscale();
    for (std::size_t i = 0; i < m_panels.size(); ++i) {
        const TraceModel &model = m_panels[i]->model();
        std::vector<PlotState::Trace> traces;
        for (int row = 0; row < model.rowCount(); ++row) {
            std::optional<PlotState::Trace> trace = PlotState::Trace::of(model.key(row), m_session);
            if (!trace)
                continue;
            trace->color = model.colorIndex(row);
            trace->visible = model.isVisible(row);
            traces.push_back(*std::move(trace));
        }
        if (i < m_waiting.size())
            traces.insert(traces.end(), m_waiting[i].begin(), m_waiting[i].end());
        state.panels.push_back(std::move(traces));
    }
    return state.toBytes();
}

void PlotArea::restoreState(const QByteArray &bytes)
{
    const std::optional<PlotState> state = PlotState::fromBytes(bytes);
    if (!state)
        return;
    m_bar->setSpan(state->spanSeconds);
    setAutoscale(state->autoscale);
    while (m_panels.size() < state->panels.size())
        addPanel();
    m_present = m_panels.front();
    m_waiting = state->panels;
    restoreTraces();
}

/// Those of m_waiting whose devices are there.
void PlotArea::restoreTraces()
{
    const std::vector<Device *> devices = m_session.devices();
    for (std::size_t i = 0; i < std::min(m_waiting.size(), m_panels.size()); ++i) {
        std::erase_if(m_waiting[i], [this, i, &devices](const PlotState::Trace &trace) {
            const std::optional<TraceKey> key = trace.find(devices);
            if (!key)
                return false;
            addTo(m_panels[i], *key);
            TraceModel &model = m_panels[i]->model();
            const int row = model.indexOf(*key);
            if (row >= 0) {
                model.setColorIndex(row, trace.color);
                model.setVisible(row, trace.visible);
            }
            return true;
        });
    }
}

} // namespace dynascope
