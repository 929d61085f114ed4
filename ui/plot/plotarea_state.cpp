// SPDX-License-Identifier: GPL-3.0-or-later
// What is remembered of the plots from one start to the next.
#include "ui/plot/plotarea.h"

#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotlayouts.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"

#include <QInputDialog>
#include <QMenu>

#include <algorithm>

namespace dynascope {

QByteArray PlotArea::saveState() const
{
    return state().toBytes();
}

PlotState PlotArea::state() const
{
    PlotState state;
    state.spanSeconds = m_bar->span();
    state.autoscale
        = std::ranges::all_of(m_panels, [](const PlotPanel *panel) { return panel->chart().isAutoscale(); });
    for (std::size_t i = 0; i < m_panels.size(); ++i) {
        PlotPanel &panel = *m_panels[i];
        const TraceModel &model = panel.model();
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
        PlotState::Look look;
        look.hasOwnTime = panel.hasOwnTime();
        look.spanSeconds = static_cast<int>(panel.ownTime().span() / std::chrono::seconds(1));
        for (const PlotScales::Scale &scale : panel.chart().scales().scales()) {
            if (scale.isByHand)
                look.axes.push_back({scale.unit, scale.scaler.range().minimum, scale.scaler.range().maximum});
        }
        state.looks.push_back(std::move(look));
    }
    state.colors = m_colors.remembered();
    state.trigger = m_trigger->state(m_session);
    return state;
}

void PlotArea::restoreState(const QByteArray &bytes)
{
    if (const std::optional<PlotState> state = PlotState::fromBytes(bytes))
        restore(*state);
}

void PlotArea::restore(const PlotState &state)
{
    m_colors.restore(state.colors);
    m_bar->setSpan(state.spanSeconds);
    setAutoscale(true);
    while (m_panels.size() < state.panels.size())
        addPanel();
    m_present = m_panels.front();
    for (std::size_t i = 0; i < std::min(state.looks.size(), m_panels.size()); ++i) {
        const PlotState::Look &look = state.looks[i];
        m_panels[i]->setOwnTime(look.hasOwnTime);
        m_panels[i]->ownTime().setSpan(std::chrono::seconds(look.spanSeconds));
        for (const PlotState::Look::Axis &axis : look.axes)
            m_panels[i]->chart().setAxisRange(axis.unit, axis.minimum, axis.maximum);
    }
    m_bar->setAutoscale(state.autoscale);
    m_waiting = state.panels;
    m_trigger->restore(state.trigger);
    restoreTraces();
}

/// Whatever was shown before goes.
void PlotArea::apply(const PlotState &state)
{
    setTriggerOn(false);
    setLive(true);
    m_waiting.clear();
    while (m_panels.size() > 1)
        closePanel(m_panels.back());
    removeFrom(m_panels.front(), m_panels.front()->model().keys());
    m_panels.front()->setOwnTime(false);
    PlotState found = plotlayouts::found(state, m_session.devices());
    found.colors = m_colors.remembered(); // newer than those of the layout
    restore(found);
}

void PlotArea::fillLayouts(QMenu &menu)
{
    menu.clear();
    QMenu *others = nullptr;
    const std::vector<Device *> devices = m_session.devices();
    const std::vector<plotlayouts::Layout> layouts = plotlayouts::load();
    for (const plotlayouts::Layout &layout : layouts) {
        QMenu *to = &menu;
        if (!plotlayouts::fits(layout.state, devices))
            to = others = others ? others : new QMenu(tr("Of &other robots"), &menu);
        connect(to->addAction(plainLabel(layout.name)), &QAction::triggered, this,
            [this, state = layout.state] { apply(state); });
    }
    if (others)
        menu.addMenu(others);
    menu.addSeparator();
    QAction *save = menu.addAction(tr("&Save layout as…"));
    save->setEnabled(!needed().empty());
    connect(save, &QAction::triggered, this, &PlotArea::askForLayoutName);
    if (layouts.empty())
        return;
    QMenu *remove = menu.addMenu(tr("&Delete"));
    for (const plotlayouts::Layout &layout : layouts)
        connect(remove->addAction(plainLabel(layout.name)), &QAction::triggered, this,
            [name = layout.name] { plotlayouts::remove(name); });
}

void PlotArea::askForLayoutName()
{
    auto *dialog = new QInputDialog(this);
    dialog->setObjectName(QStringLiteral("layoutNameDialog"));
    dialog->setWindowTitle(tr("Save layout"));
    dialog->setLabelText(tr("Name of the layout (one of the same name is replaced)"));
    connect(dialog, &QInputDialog::textValueSelected, this, [this](const QString &name) {
        if (plotlayouts::store(name, state()))
            emit posted({MessageKind::Success, tr("Saved the layout %1").arg(name.simplified()), {}, {}, QStringLiteral("save")});
        else
            emit posted({MessageKind::Error, tr("The layout was not saved: it needs a name, and there may be 64"), {}, {}, QStringLiteral("save")});
    });
    present(*dialog);
}

/// Those of m_waiting whose devices are there.
void PlotArea::restoreTraces()
{
    const std::vector<Device *> devices = m_session.devices();
    m_trigger->findTrace(devices);
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
