// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"
#include "ui/common/messagebar.h"
#include "ui/common/workbench.h"
#include "ui/plot/areatrigger.h"
#include "ui/plot/plotcursors.h"
#include "ui/plot/tracecolors.h"

#include <QTimer>
#include <QWidget>

class QAction;
class QMenu;
class QSplitter;

namespace dynascope {

class Journal;
class PlotBar;
class PlotPanel;
class PlotSaver;
class RamGuard;

/// One or more plot panels under a common tool bar. Watches what it shows and stops watching what it no longer shows.
class PlotArea : public QWidget
{
    Q_OBJECT

public:
    explicit PlotArea(const Workbench &workbench, QWidget *parent = nullptr);
    PlotArea(Session &session, Monitor &monitor, QWidget *parent = nullptr); ///< without journal
    PlotArea(Session &session, Monitor &monitor, const Journal *journal, const RamGuard *guard, QWidget *parent);
    ~PlotArea() override;

    void addTrace(const TraceKey &key); ///< to the present panel; nothing if it is shown already
    void removeTrace(const Watch &watch);
    bool shows(const TraceKey &key) const;
    std::vector<Watch> traces() const; ///< those that aren't derived

    PlotPanel *addPanel();
    void closePanel(PlotPanel *panel); ///< with its traces; the last one stays
    const std::vector<PlotPanel *> &panels() const { return m_panels; }
    const TimeWindow &timeWindow() const { return m_window; }
    void setLive(bool live);
    void follow(); ///< a replay has gone on, or elsewhere: what is live ends there
    void showTimes(LineTime from, LineTime to); ///< pauses
    void setRecording(LineTime begin, LineTime end); ///< where paused time axes have their 0 s, and how far they go
    void setAutoscale(bool on);
    void setCursorsOn(bool on);
    PlotTrigger &trigger() const { return m_trigger->trigger(); }
    void arm(const TriggerChoice &choice);
    void askForTrigger() { m_trigger->ask(); }
    void setTriggerOn(bool on);
    EventLog &events() const { return *m_events; }
    const PlotCursors &cursors() const { return m_cursors; }
    void setUnits(const UnitPreferences &units); ///< axes, readouts, lists, and what is saved

    std::vector<QAction *> saveActions() const; ///< CSV and picture, for a menu

    QByteArray saveState() const;
    /// Traces of devices that aren't there yet come back when these are found.
    void restoreState(const QByteArray &state);
    PlotState state() const;
    void apply(const PlotState &state); ///< in place of what is shown
    void fillLayouts(QMenu &menu);

signals:
    void tracesChanged();
    void posted(const dynascope::Message &message);

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    void connectBar();
    void connectChart(PlotPanel *panel);
    TimeWindow &windowOf(PlotPanel *panel);
    LineTime newest() const;
    LineTime last() const;
    void addTo(PlotPanel *panel, const TraceKey &key);
    void removeFrom(PlotPanel *panel, const std::vector<TraceKey> &keys);
    std::set<Watch> needed() const;
    void derive();
    void onTracesChanged();
    void onFrame();
    void showNewest();
    void refreshAll();
    void showAutoscale();
    void showCursors();
    void moveCursor(int which, LineTime at);
    void measure();
    void clear();
    void restoreTraces();
    void restore(const PlotState &state);
    void askForLayoutName();

    Session &m_session;
    Monitor &m_monitor;
    TimeWindow m_window;
    UnitPreferences m_units;
    TraceColors m_colors;
    EventLog *m_events;
    PlotBar *m_bar;
    QSplitter *m_splitter;
    std::vector<PlotPanel *> m_panels; ///< the splitter's
    PlotPanel *m_present = nullptr;    ///< where new traces go
    PlotCursors m_cursors;
    QTimer m_frames;
    QTimer m_values; ///< for the numbers in the lists: no faster than can be read
    std::uint64_t m_samplesSeen = 0;
    LineTime m_recordingEnd{};
    std::vector<std::vector<PlotState::Trace>> m_waiting; ///< per panel: remembered, but the device isn't there yet
    std::unique_ptr<AreaTrigger> m_trigger; ///< these look at the panels
    std::unique_ptr<PlotSaver> m_saver;
};

} // namespace dynascope
