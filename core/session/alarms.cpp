// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/alarms.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

/// The context of what is translated here.
class AlarmTexts
{
    Q_DECLARE_TR_FUNCTIONS(AlarmTexts)
};

/// When a kind is near its limit and over it, and how far it must come back, all in the unit of the value; how long it
/// must have been so. A little less than whole seconds: a reading a second comes now and then a little early.
struct Thresholds {
    double near = 0, over = 0;
    double back = 0;
    LineTime raiseAfter{}, clearAfter{};
};

constexpr double NearTemperature = 10; ///< °C below the limit
constexpr double BackTemperature = 3;
constexpr double NearVoltage = 0.03; ///< of the limit
constexpr double BackVoltage = 0.01;
constexpr double NearLoad = 0.8;
constexpr double OverLoad = 0.95; ///< a current that is held at its limit is measured now above, now below
constexpr double BackLoad = 0.1;
constexpr LineTime Settled = 1900ms;

Thresholds thresholdsOf(AlarmKind kind, double limit)
{
    switch (kind) {
    case AlarmKind::Temperature: return {limit - NearTemperature, limit, BackTemperature, 900ms, Settled};
    case AlarmKind::OverVoltage: return {limit * (1 - NearVoltage), limit, limit * BackVoltage, 900ms, Settled};
    // Turned round, so that more is worse.
    case AlarmKind::UnderVoltage: return {-limit * (1 + NearVoltage), -limit, limit * BackVoltage, 900ms, Settled};
    case AlarmKind::Load: return {limit * NearLoad, limit * OverLoad, limit * BackLoad, 900ms, Settled};
    case AlarmKind::Error:
    case AlarmKind::Silent: break;
    }
    return {};
}

Vital vitalOf(AlarmKind kind)
{
    switch (kind) {
    case AlarmKind::Temperature: return Vital::Temperature;
    case AlarmKind::OverVoltage:
    case AlarmKind::UnderVoltage: return Vital::Voltage;
    case AlarmKind::Load: return Vital::Load;
    case AlarmKind::Error:
    case AlarmKind::Silent: break;
    }
    return Vital::Error;
}

/// At its limit a value is still within. What counts as beyond must come back some way.
AlarmLevel levelOf(double value, const Thresholds &thresholds, AlarmLevel now)
{
    const double over = thresholds.over - (now >= AlarmLevel::Over ? thresholds.back : 0);
    const double near = thresholds.near - (now >= AlarmLevel::Near ? thresholds.back : 0);
    return value > over ? AlarmLevel::Over : value > near ? AlarmLevel::Near : AlarmLevel::None;
}

QString number(const Physical &value, double what)
{
    const QString figure = QString::number(what, 'f', value.decimals);
    return value.unit.isEmpty() ? figure : figure + u' ' + value.unit;
}

QString causeText(AlarmKind kind, const VitalReading &reading, const VitalLimit &limit)
{
    const QString name = limit.source == LimitSource::Device ? AlarmTexts::tr("its %1").arg(limit.name)
                                                             : AlarmTexts::tr("the factory's %1").arg(limit.name);
    const QString value = number(reading.value, reading.value.value);
    const QString bound = number(reading.value, limit.value);
    if (kind == AlarmKind::Load) {
        return AlarmTexts::tr("%1, %2 % of %3 of %4")
            .arg(value)
            .arg(std::lround(100 * std::abs(reading.value.value) / limit.value))
            .arg(name, bound);
    }
    return AlarmTexts::tr("%1, %2 is %3").arg(value, name, bound);
}

/// Nothing where it isn't known.
std::optional<AlarmLevel> levelNow(AlarmKind kind, const VitalReading &reading, const VitalLimit &limit, AlarmLevel now)
{
    if (!reading.raw || !limit.isKnown())
        return std::nullopt;
    double value = reading.value.value;
    if (kind == AlarmKind::Load)
        value = std::abs(value);
    else if (kind == AlarmKind::UnderVoltage)
        value = -value;
    return levelOf(value, thresholdsOf(kind, limit.value), now);
}

/// How long `next` must have been so before it is taken for true.
LineTime patience(AlarmKind kind, AlarmLevel now, AlarmLevel next)
{
    if (kind == AlarmKind::Error)
        return {};
    if (kind == AlarmKind::Silent)
        return next > now ? LineTime() : Settled;
    const Thresholds thresholds = thresholdsOf(kind, 1);
    return next > now ? thresholds.raiseAfter : thresholds.clearAfter;
}

} // namespace

QString alarmKindText(AlarmKind kind)
{
    switch (kind) {
    case AlarmKind::Error: return AlarmTexts::tr("Hardware error");
    case AlarmKind::Silent: return AlarmTexts::tr("Silent");
    case AlarmKind::Temperature: return AlarmTexts::tr("Temperature");
    case AlarmKind::OverVoltage: return AlarmTexts::tr("Overvoltage");
    case AlarmKind::UnderVoltage: return AlarmTexts::tr("Undervoltage");
    case AlarmKind::Load: return AlarmTexts::tr("Load");
    }
    return {};
}

bool Alarms::take(const Subject &subject, const Vitals &vitals, const Now &now)
{
    States &states = m_states[subject.device];
    bool changed = false;
    for (int i = 0; i < AlarmKindCount; ++i) {
        const auto kind = static_cast<AlarmKind>(i);
        State &state = states[static_cast<std::size_t>(i)];
        Wanted wanted{AlarmLevel::None, now.at, {}};
        if (kind == AlarmKind::Silent) {
            if (!vitals.isThere && !vitals.isSilent)
                continue; // parked, rebooting, or its line is gone
            wanted.level = vitals.isSilent ? AlarmLevel::Over : AlarmLevel::None;
            wanted.cause = AlarmTexts::tr("Does not answer");
        } else if (kind == AlarmKind::Error) {
            if (!vitals.isThere)
                continue;
            wanted.level = vitals.errors.isEmpty() ? AlarmLevel::None : AlarmLevel::Over;
            wanted.cause = vitals.errors;
        } else {
            const VitalReading &reading = vitals[vitalOf(kind)];
            const VitalLimit &limit = kind == AlarmKind::UnderVoltage ? reading.low : reading.high;
            const auto level = levelNow(kind, reading, limit, state.level);
            if (!level)
                continue;
            wanted = {*level, reading.at, {}};
            if (*level > state.level) // the text is made only where it may be shown
                wanted.cause = causeText(kind, reading, limit);
        }
        changed |= follow(subject, kind, state, wanted, now);
    }
    return changed;
}

bool Alarms::follow(const Subject &subject, AlarmKind kind, State &state, const Wanted &wanted, const Now &now)
{
    Alarm *const open = entry(state.alarm);
    if (wanted.level == state.level) {
        state.next = state.level;
        if (kind != AlarmKind::Error || !open || wanted.cause.isEmpty() || open->cause == wanted.cause)
            return false;
        open->cause = wanted.cause; // one more error
        return true;
    }
    // Another clock, after a line was opened anew: what was so before says nothing about how long.
    const bool isWorse = wanted.level > state.level;
    const bool goesOn = state.next != state.level && (state.next > state.level) == isWorse && wanted.at >= state.latest;
    if (!goesOn)
        state.since = wanted.at;
    // Of what it was meanwhile the nearest to what it is counted as.
    state.next = !goesOn   ? wanted.level
                 : isWorse ? std::min(state.next, wanted.level)
                           : std::max(state.next, wanted.level);
    state.latest = wanted.at;
    if (wanted.at - state.since < patience(kind, state.level, state.next))
        return false;
    state.level = state.next;
    if (state.level == AlarmLevel::None)
        return end(state, now.wall, false);
    if (!isWorse)
        return false; // from over to near: the same episode
    raise(subject, kind, state, wanted, now);
    return true;
}

void Alarms::raise(const Subject &subject, AlarmKind kind, State &state, const Wanted &wanted, const Now &now)
{
    if (Alarm *open = entry(state.alarm)) { // from near to over
        if (state.level > open->level) {
            open->level = state.level;
            open->cause = wanted.cause;
        }
        return;
    }
    Alarm alarm;
    alarm.number = ++m_last;
    alarm.device = subject.device;
    alarm.name = subject.name;
    alarm.kind = kind;
    alarm.level = state.level;
    alarm.cause = wanted.cause;
    alarm.raised = now.wall;
    state.alarm = alarm.number;
    m_list.push_back(std::move(alarm));
    bound();
}

bool Alarms::end(State &state, const QDateTime &wall, bool deviceWent)
{
    Alarm *alarm = entry(std::exchange(state.alarm, 0));
    if (!alarm)
        return false;
    alarm->cleared = wall;
    alarm->deviceWent = deviceWent;
    return true;
}

bool Alarms::remove(DeviceKey device, const QDateTime &wall)
{
    const auto at = m_states.find(device);
    if (at == m_states.end())
        return false;
    bool changed = false;
    for (State &state : at->second)
        changed |= end(state, wall, true);
    m_states.erase(at);
    return changed;
}

void Alarms::clearEnded()
{
    std::erase_if(m_list, [](const Alarm &alarm) { return !alarm.isActive(); });
}

void Alarms::bound()
{
    while (m_list.size() > Most) {
        const auto ended = std::ranges::find_if(m_list, [](const Alarm &alarm) { return !alarm.isActive(); });
        m_list.erase(ended != m_list.end() ? ended : m_list.begin());
    }
}

Alarm *Alarms::entry(quint64 number)
{
    const auto at = std::ranges::lower_bound(m_list, number, {}, &Alarm::number);
    return at != m_list.end() && at->number == number ? &*at : nullptr;
}

const Alarm *Alarms::find(quint64 number) const
{
    const auto at = std::ranges::lower_bound(m_list, number, {}, &Alarm::number);
    return at != m_list.end() && at->number == number ? &*at : nullptr;
}

AlarmLevel Alarms::level(DeviceKey device, AlarmKind kind) const
{
    const auto at = m_states.find(device);
    return at == m_states.end() ? AlarmLevel::None : at->second[static_cast<std::size_t>(kind)].level;
}

AlarmLevel Alarms::level(DeviceKey device) const
{
    AlarmLevel worst = AlarmLevel::None;
    for (int kind = 0; kind < AlarmKindCount; ++kind)
        worst = std::max(worst, level(device, static_cast<AlarmKind>(kind)));
    return worst;
}

std::size_t Alarms::active() const
{
    return static_cast<std::size_t>(std::ranges::count_if(m_list, &Alarm::isActive));
}

} // namespace dynascope
