// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/eventlog.h"
#include "core/session/trigger.h"

#include "ui/plot/triggermark.h"

#include <QObject>

namespace dynascope {

class TraceModel;

/// What the plots are triggered by, as a person set it: in the units shown.
struct TriggerChoice {
    TraceKey trace{};    ///< not of an event
    double level = 0;
    double hysteresis = 0;
    TriggerSettings settings{}; ///< but level and hysteresis

    friend bool operator==(const TriggerChoice &, const TriggerChoice &) = default;
};

/// The trigger of a plot area: feeds core's Trigger and says what to show. GUI thread.
class PlotTrigger : public QObject
{
    Q_OBJECT

public:
    explicit PlotTrigger(EventLog &log, QObject *parent = nullptr);

    bool isOn() const { return m_trigger.state() != Trigger::State::Off; }
    bool isDone() const { return m_trigger.state() == Trigger::State::Done; }
    const TriggerChoice &choice() const { return m_choice; }
    void choose(const TriggerChoice &choice); ///< setOn() then begins it
    void setOn(bool on, LineTime now);

    /// With each frame. `model` holds the trace, if it is shown; `now` is the newest sample of all, in a replay where that
    /// stands; gone back, it is armed anew there. True: shown() changed.
    bool advance(const TraceModel *model, const History *history, LineTime now, std::size_t &budget);
    std::optional<LineTime> shown() const { return m_trigger.shown(); }
    TriggerMark mark(const TraceModel *model) const;

private:
    void lookAtEvents(LineTime now);

    const EventLog &m_log;
    TriggerChoice m_choice;
    Trigger m_trigger;
    // In a replay:
    LineTime m_now{};            ///< where it stood at the last look
    std::size_t m_nextEvent = 0; ///< of the log
};

} // namespace dynascope
