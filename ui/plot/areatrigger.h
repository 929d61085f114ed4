// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "ui/plot/plotstate.h"
#include "ui/plot/plottrigger.h"
#include "ui/plot/timewindow.h"

namespace dynascope {

class PlotPanel;

/// The trigger over all panels of a plot area: looks at its trace wherever that is shown, makes the view stand where it
/// fired, and has the charts say so. GUI thread.
class AreaTrigger : public QObject
{
    Q_OBJECT

public:
    /// What is shown, in which time, and where the dialog belongs; all outlive this.
    AreaTrigger(EventLog &log, Monitor &monitor, const std::vector<PlotPanel *> &panels, TimeWindow &window, QWidget &area);

    PlotTrigger &trigger() { return m_trigger; }
    void arm(const TriggerChoice &choice, LineTime now);
    void setOn(bool on, LineTime now); ///< asks by what, where nobody has said so
    void ask();
    bool isLooking() const { return m_trigger.isOn() && (m_window.isLive() || m_isHeld); } ///< a person's pause stays
    void look(LineTime now); ///< with each frame while it is

    bool isHeld() const { return m_isHeld; } ///< the view stands where the trigger put it
    void letGo() { m_isHeld = false; }       ///< it was moved or zoomed, or is live again: it stays so

    PlotState::TriggerState state(const Session &session) const;
    void restore(const PlotState::TriggerState &state); ///< its trace may come later
    void findTrace(const std::vector<Device *> &devices);

signals:
    void chosen(const dynascope::TriggerChoice &choice); ///< in the dialog: to be armed
    void armedChanged(bool isArmed);
    void liveRequested();
    void stood(); ///< it fired: what stands now is the time around

private:
    PlotPanel *panel() const; ///< which has its trace
    void stand(LineTime at, LineTime now);
    void show();

    Monitor &m_monitor;
    const std::vector<PlotPanel *> &m_panels;
    TimeWindow &m_window;
    QWidget &m_area;
    PlotTrigger m_trigger;
    bool m_isHeld = false;
    std::optional<PlotState::Trace> m_waiting; ///< its device isn't there yet
};

} // namespace dynascope
