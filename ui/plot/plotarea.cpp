// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotarea.h"

#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/plotsaver.h"
#include "ui/plot/tracemodel.h"

#include <QMenu>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto FrameInterval = 16ms;
constexpr auto ValueInterval = 100ms;

} // namespace

PlotArea::PlotArea(const Workbench &workbench, QWidget *parent)
    : PlotArea(workbench.session, workbench.monitor, workbench.journal, workbench.ramGuard, parent)
{
}

PlotArea::PlotArea(Session &session, Monitor &monitor, QWidget *parent)
    : PlotArea(session, monitor, nullptr, nullptr, parent)
{
}

PlotArea::PlotArea(Session &session, Monitor &monitor, const Journal *journal, const RamGuard *guard, QWidget *parent)
    : QWidget(parent)
    , m_session(session)
    , m_monitor(monitor)
    , m_colors(session)
    , m_events(new EventLog(session, journal, guard, this))
    , m_bar(new PlotBar(this))
    , m_splitter(new QSplitter(Qt::Vertical, this))
    , m_trigger(std::make_unique<AreaTrigger>(*m_events, monitor, m_panels, m_window, *this))
    , m_saver(std::make_unique<PlotSaver>(monitor, m_panels, *this))
{
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_bar);
    auto *scrolled = new QScrollArea(this); // where there are more panels than a low window can show
    scrolled->setFrameShape(QFrame::NoFrame);
    scrolled->setWidgetResizable(true);
    scrolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scrolled->setFocusPolicy(Qt::NoFocus);
    scrolled->setWidget(m_splitter);
    layout->addWidget(scrolled, 1);
    m_splitter->setChildrenCollapsible(false);
    m_frames.setInterval(FrameInterval);
    m_frames.setTimerType(Qt::PreciseTimer);
    m_values.setInterval(ValueInterval);
    connect(&m_frames, &QTimer::timeout, this, &PlotArea::onFrame);
    connect(&m_values, &QTimer::timeout, this, [this] {
        for (PlotPanel *panel : m_panels)
            panel->model().refreshValues();
        for (PlotPanel *panel : m_panels)
            panel->showFigures();
    });
    // A device that goes takes its histories along: the charts must let go of them at once.
    connect(&monitor, &Monitor::watchesChanged, this, &PlotArea::refreshAll);
    connect(&session, &Session::deviceAdded, this, &PlotArea::restoreTraces);
    connect(&session, &Session::deviceAdded, this, [this](Device *device) {
        for (const Watch &watch : needed()) {
            if (watch.device == device->key()) // it is back
                m_monitor.watch(watch);
        }
    });
    connectBar();
    if (monitor.isRecorded())
        m_bar->beOfRecording();
    addPanel();
}

PlotArea::~PlotArea() = default;

void PlotArea::connectBar()
{
    connect(m_bar, &PlotBar::liveChanged, this, &PlotArea::setLive);
    connect(m_bar, &PlotBar::autoscaleChanged, this, &PlotArea::setAutoscale);
    connect(m_bar, &PlotBar::spanChanged, this, [this](int seconds) {
        m_window.setSpan(std::chrono::seconds(seconds));
        showNewest();
    });
    connect(m_bar, &PlotBar::clearRequested, this, &PlotArea::clear);
    for (QAction *action : m_bar->saveActions())
        addAction(action); // their keys work though they are in a menu
    connect(&m_bar->layouts(), &QMenu::aboutToShow, this, [this] { fillLayouts(m_bar->layouts()); });
    connect(m_bar, &PlotBar::drawingRequested, m_saver.get(), &PlotSaver::saveDrawing);
    connect(m_bar, &PlotBar::csvRequested, this, [this] { m_saver->saveCsv(*m_present); });
    connect(m_bar, &PlotBar::pictureRequested, m_saver.get(), &PlotSaver::savePicture);
    connect(m_saver.get(), &PlotSaver::posted, this, &PlotArea::posted);
    connect(m_bar, &PlotBar::panelRequested, this, &PlotArea::addPanel);
    connect(m_bar, &PlotBar::cursorsChanged, this, &PlotArea::setCursorsOn);
    connect(m_bar, &PlotBar::triggerChanged, this, &PlotArea::setTriggerOn);
    connect(m_bar, &PlotBar::triggerSettingsRequested, m_trigger.get(), &AreaTrigger::ask);
    connect(m_trigger.get(), &AreaTrigger::chosen, this, &PlotArea::arm);
    connect(m_trigger.get(), &AreaTrigger::armedChanged, m_bar, &PlotBar::setTrigger);
    connect(m_trigger.get(), &AreaTrigger::liveRequested, this, [this] { setLive(true); });
    connect(m_trigger.get(), &AreaTrigger::stood, this, [this] {
        m_bar->setLive(false);
        refreshAll();
    });
}

std::vector<QAction *> PlotArea::saveActions() const
{
    return m_bar->saveActions();
}

PlotPanel *PlotArea::addPanel()
{
    auto *panel = new PlotPanel(PlotPanel::Common{m_session, m_monitor, m_window, m_colors, *m_events}, m_splitter);
    m_splitter->addWidget(panel);
    m_panels.push_back(panel);
    m_present = panel;
    panel->model().setUnits(m_units);
    panel->setCursors(m_cursors);
    panel->setLive(m_window.isLive());
    connect(panel, &PlotPanel::activated, this, [this, panel] { m_present = panel; });
    connect(panel, &PlotPanel::liveRequested, this, [this] { setLive(true); });
    connect(panel, &PlotPanel::ownTimeChanged, this, &PlotArea::showNewest);
    connect(panel, &PlotPanel::closeRequested, this, [this, panel] { closePanel(panel); });
    connect(panel, &PlotPanel::removeRequested, this,
        [this, panel](const std::vector<TraceKey> &keys) { removeFrom(panel, keys); });
    connect(panel, &PlotPanel::deriveRequested, this, [this, panel](const TraceKey &key) { addTo(panel, key); });
    connect(panel, &PlotPanel::watchesDropped, this, [this, panel](const std::vector<Watch> &watches) {
        for (const Watch &watch : watches)
            addTo(panel, watch);
    });
    connectChart(panel);
    for (PlotPanel *each : m_panels)
        each->setClosable(m_panels.size() > 1);
    showNewest();
    return panel;
}

void PlotArea::connectChart(PlotPanel *panel)
{
    PlotChart *chart = &panel->chart();
    connect(chart, &PlotChart::spanStepped, this, [this, panel](int steps) {
        if (!panel->hasOwnTime())
            return m_bar->stepSpan(steps);
        panel->ownTime().setSpan(SpanBox::stepped(panel->ownTime().span(), steps));
        showNewest();
    });
    connect(chart, &PlotChart::pauseRequested, this, [this] { setLive(false); });
    connect(chart, &PlotChart::zoomed, this, [this, panel](double factor, LineTime around) {
        m_trigger->letGo();
        windowOf(panel).zoom(factor, around);
        showNewest();
    });
    connect(chart, &PlotChart::panned, this, [this, panel](LineTime by) {
        m_trigger->letGo();
        windowOf(panel).pan(by);
        showNewest();
    });
    connect(chart, &PlotChart::timesChosen, this, [this, panel](LineTime from, LineTime to) {
        m_trigger->letGo();
        windowOf(panel).show(from, to);
        showNewest();
    });
    connect(chart, &PlotChart::cursorMoved, this, &PlotArea::moveCursor);
    connect(chart, &PlotChart::cursorsToggled, this, [this] { setCursorsOn(!m_cursors.isOn); });
    connect(chart, &PlotChart::triggerLevelChosen, this, [this](double level) {
        TriggerChoice choice = trigger().choice();
        choice.level = level;
        arm(choice);
    });
    connect(chart, &PlotChart::autoscaleChanged, this, &PlotArea::showAutoscale);
    connect(chart, &PlotChart::fitRequested, this, [this] {
        setLive(true);
        setAutoscale(true);
    });
}

void PlotArea::closePanel(PlotPanel *panel)
{
    if (m_panels.size() < 2)
        return;
    removeFrom(panel, panel->model().keys());
    // What waits is kept per panel: it goes with its own.
    const auto at = std::ranges::find(m_panels, panel);
    if (const auto index = at - m_panels.begin(); index < std::ssize(m_waiting))
        m_waiting.erase(m_waiting.begin() + index);
    m_panels.erase(at);
    if (m_present == panel)
        m_present = m_panels.back();
    panel->hide();
    panel->deleteLater(); // it may be its own button that asked
    for (PlotPanel *each : m_panels)
        each->setClosable(m_panels.size() > 1);
}

void PlotArea::addTrace(const TraceKey &key)
{
    if (!shows(key))
        addTo(m_present, key);
}

void PlotArea::addTo(PlotPanel *panel, const TraceKey &key)
{
    if (!panel->model().add(key))
        return;
    for (const Watch &watch : panel->model().needed())
        m_monitor.watch(watch);
    onTracesChanged();
}

void PlotArea::removeTrace(const Watch &watch)
{
    for (PlotPanel *panel : m_panels)
        removeFrom(panel, {watch});
}

void PlotArea::removeFrom(PlotPanel *panel, const std::vector<TraceKey> &keys)
{
    const std::set<Watch> before = panel->model().needed();
    bool isAnyRemoved = false;
    for (const TraceKey &key : keys) {
        const int row = panel->model().indexOf(key);
        if (row < 0)
            continue;
        panel->model().remove(row);
        isAnyRemoved = true;
    }
    const std::set<Watch> still = needed();
    for (const Watch &watch : before) {
        if (!still.contains(watch))
            m_monitor.unwatch(watch);
    }
    if (isAnyRemoved)
        onTracesChanged();
}

void PlotArea::onTracesChanged()
{
    const bool isEmpty = needed().empty();
    m_bar->setHasTraces(!isEmpty);
    if (isEmpty)
        setLive(true);
    refreshAll();
    showCursors();
    emit tracesChanged();
}

bool PlotArea::shows(const TraceKey &key) const
{
    return std::ranges::any_of(
        m_panels, [&key](const PlotPanel *panel) { return panel->model().indexOf(key) >= 0; });
}

std::vector<Watch> PlotArea::traces() const
{
    std::set<Watch> all;
    for (const PlotPanel *panel : m_panels) {
        const std::vector<Watch> watches = panel->model().watches();
        all.insert(watches.begin(), watches.end());
    }
    return {all.begin(), all.end()};
}

std::set<Watch> PlotArea::needed() const
{
    std::set<Watch> all;
    for (const PlotPanel *panel : m_panels)
        all.merge(panel->model().needed());
    return all;
}

void PlotArea::showEvent(QShowEvent *event)
{
    QWidget::showEvent(event);
    m_frames.start();
    m_values.start();
    refreshAll();
}

void PlotArea::hideEvent(QHideEvent *event)
{
    QWidget::hideEvent(event);
    m_frames.stop();
    m_values.stop();
}

/// Paints only where something new has come; what is paused stands still anyway.
void PlotArea::onFrame()
{
    derive();
    if (m_trigger->isLooking())
        m_trigger->look(newest());
    measure();
    if (!m_window.isLive())
        return;
    std::uint64_t samples = 0;
    for (const PlotPanel *panel : m_panels)
        samples += panel->samplesSeen();
    if (samples == m_samplesSeen)
        return;
    m_samplesSeen = samples;
    refreshAll();
}

void PlotArea::refreshAll()
{
    LabelColumns room;
    for (PlotPanel *panel : m_panels) {
        panel->refreshTraces();
        room = room.unitedWith(panel->chart().labelColumns());
    }
    for (PlotPanel *panel : m_panels)
        panel->setLabelRoom(room);
    showNewest();
}

/// All panels end at the same moment, so that what stands above each other happened together.
void PlotArea::showNewest()
{
    const LineTime at = newest();
    for (PlotPanel *panel : m_panels)
        panel->setNewest(at);
}

void PlotArea::setAutoscale(bool on)
{
    m_bar->setAutoscale(on);
    for (PlotPanel *panel : m_panels)
        panel->chart().setAutoscale(on);
}

void PlotArea::showAutoscale()
{
    m_bar->setAutoscale(
        std::ranges::all_of(m_panels, [](const PlotPanel *panel) { return panel->chart().isAutoscale(); }));
}

void PlotArea::setUnits(const UnitPreferences &units)
{
    if (units == m_units)
        return;
    m_units = units;
    for (PlotPanel *panel : m_panels)
        panel->model().setUnits(units);
    setAutoscale(true); // ranges by hand were of the other units
    refreshAll();
}

void PlotArea::clear()
{
    if (m_monitor.isRecorded())
        return;
    m_monitor.clear();
    m_events->clear();
    m_samplesSeen = 0;
    setLive(true);
    for (PlotPanel *panel : m_panels)
        panel->model().refreshValues();
}

} // namespace dynascope
