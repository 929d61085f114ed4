// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plottrigger.h"

#include "ui/common/texts.h"
#include "ui/plot/tracemodel.h"

#include <cmath>

namespace dynascope {

PlotTrigger::PlotTrigger(EventLog &log, QObject *parent) : QObject(parent), m_log(log)
{
    connect(&log, &EventLog::added, this, [this](const LoggedEvent &event) { m_trigger.event(event.at); });
}

void PlotTrigger::choose(const TriggerChoice &choice)
{
    m_choice = choice;
    m_trigger.set(choice.settings); // an event may come before the next frame
}

void PlotTrigger::setOn(bool on, LineTime now)
{
    m_now = now;
    m_nextEvent = m_log.indexAt(now);
    if (on)
        m_trigger.arm(now);
    else
        m_trigger.disarm();
}

/// A recording's are all in the log before their time has come. While one fills, those behind it wait.
void PlotTrigger::lookAtEvents(LineTime now)
{
    const auto &events = m_log.events();
    for (; m_nextEvent < events.size() && events[m_nextEvent].at <= now; ++m_nextEvent) {
        if (m_trigger.state() != Trigger::State::Armed)
            return;
        m_trigger.event(events[m_nextEvent].at);
    }
}

bool PlotTrigger::advance(const TraceModel *model, const History *history, LineTime now, std::size_t &budget)
{
    if (!isOn())
        return false;
    TriggerSettings settings = m_choice.settings;
    const int row = model ? model->indexOf(m_choice.trace) : -1;
    if (row >= 0 && settings.kind != TriggerSettings::Kind::Event) {
        const TraceModel::Linear scale = model->scaleOf(row);
        settings.level = scale.scale != 0 ? (m_choice.level - scale.offset) / scale.scale : 0;
        settings.hysteresis = scale.scale != 0 ? m_choice.hysteresis / std::abs(scale.scale) : 0;
        if (scale.scale < 0 && settings.kind != TriggerSettings::Kind::Either)
            settings.kind = settings.kind == TriggerSettings::Kind::Rising ? TriggerSettings::Kind::Falling
                                                                           : TriggerSettings::Kind::Rising;
    }
    if (row >= 0 || settings.kind == TriggerSettings::Kind::Event) // without its trace it waits as it is
        m_trigger.set(settings);
    if (m_log.isRecorded()) {
        if (now < m_now) {
            const bool wasShown = shown().has_value();
            setOn(true, now);
            return wasShown;
        }
        m_now = now;
        lookAtEvents(now);
    }
    return m_trigger.advance(row >= 0 ? history : nullptr, now, budget);
}

TriggerMark PlotTrigger::mark(const TraceModel *model) const
{
    TriggerMark mark;
    mark.isOn = isOn();
    if (!mark.isOn)
        return mark;
    mark.isShown = shown().has_value();
    const int row = model ? model->indexOf(m_choice.trace) : -1;
    QString what = tr("an event");
    if (m_choice.settings.kind != TriggerSettings::Kind::Event) {
        what = tr("a trace that isn't shown");
        if (row >= 0) {
            const TraceModel::Linear scale = model->scaleOf(row);
            mark.hasLevel = true;
            mark.level = m_choice.level;
            mark.unit = scale.unit;
            const QString arrow = m_choice.settings.kind == TriggerSettings::Kind::Rising ? QStringLiteral("↗")
                : m_choice.settings.kind == TriggerSettings::Kind::Falling                ? QStringLiteral("↘")
                                                                                          : QStringLiteral("↕");
            what = QStringLiteral("%1 %2 %3").arg(arrow, withMinus(QString::number(mark.level, 'f', scale.decimals)), scale.unit);
        }
    }
    switch (m_trigger.state()) {
    case Trigger::State::Off:
    case Trigger::State::Armed: mark.text = mark.isShown ? tr("Triggered, armed again: %1").arg(what) : tr("Waiting for %1").arg(what); break;
    case Trigger::State::Filling: mark.text = tr("Triggered: %1").arg(what); break;
    case Trigger::State::Done: mark.text = tr("Triggered once: %1").arg(what); break;
    }
    return mark;
}

} // namespace dynascope
