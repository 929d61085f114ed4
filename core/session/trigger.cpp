// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/trigger.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

void Trigger::set(const TriggerSettings &settings)
{
    if (settings == m_settings)
        return;
    m_settings = settings;
    if (m_state != State::Off)
        arm(m_since);
}

void Trigger::arm(LineTime now)
{
    m_state = State::Armed;
    m_from = now;
    m_since = now;
    m_mark = {};
    m_next = 0;
    m_wasBelow = false;
    m_wasAbove = false;
    m_fired.reset();
    m_shown.reset();
}

void Trigger::disarm()
{
    m_state = State::Off;
    m_fired.reset();
    m_shown.reset();
}

void Trigger::fire(LineTime at)
{
    if (m_state != State::Armed || at < m_from)
        return;
    m_fired = at;
    m_state = State::Filling;
}

void Trigger::event(LineTime at)
{
    if (m_settings.kind == TriggerSettings::Kind::Event)
        fire(at);
}

void Trigger::take(const History::Sample &before, const History::Sample &now, bool isKnown)
{
    using Kind = TriggerSettings::Kind;
    if (!isKnown) {
        m_wasBelow = false;
        m_wasAbove = false;
    }
    const double level = m_settings.level;
    const double value = now.raw;
    const bool rises = m_wasBelow && value >= level;
    const bool falls = m_wasAbove && value <= level;
    if ((rises && m_settings.kind != Kind::Falling) || (falls && m_settings.kind != Kind::Rising)) {
        const double whole = value - before.raw;
        const double part = whole == 0 ? 1 : std::clamp((level - before.raw) / whole, 0.0, 1.0);
        fire(before.at + LineTime(std::llround(part * static_cast<double>((now.at - before.at).count()))));
    }
    // Without hysteresis a value at the level itself counts on neither side.
    m_wasBelow = (m_wasBelow && value < level) || value < level - m_settings.hysteresis;
    m_wasAbove = (m_wasAbove && value > level) || value > level + m_settings.hysteresis;
}

bool Trigger::advance(const History *source, LineTime now, std::size_t &budget)
{
    if (m_state == State::Off || m_state == State::Done)
        return false;
    if (source && !source->isEmpty() && m_settings.kind != TriggerSettings::Kind::Event) {
        const std::uint64_t first = source->appended() - source->size();
        if (m_next == 0 || !m_mark.stillHolds(*source)) { // begins with the sample that holds at m_from
            const std::size_t index = source->indexAt(m_from);
            m_next = first + (index > 0 ? index - 1 : 0);
            m_wasBelow = false;
            m_wasAbove = false;
        }
        m_mark = HistoryMark::of(*source);
        m_next = std::max(m_next, first);
        for (; m_next < source->appended() && budget > 0; ++m_next, --budget) {
            const auto index = static_cast<std::size_t>(m_next - first);
            const History::Sample sample = source->at(index);
            const bool isKnown = index > 0 && !source->gapBefore(index);
            take(isKnown ? source->at(index - 1) : sample, sample, isKnown);
            if (m_state == State::Filling && sample.at >= *m_fired + m_settings.after)
                break; // what follows may fire again
        }
    }
    if (m_state == State::Filling && now >= *m_fired + m_settings.after) {
        m_shown = m_fired;
        m_from = *m_fired + m_settings.after;
        m_since = now;
        m_fired.reset();
        m_state = m_settings.mode == TriggerSettings::Mode::Single ? State::Done : State::Armed;
        return true;
    }
    if (m_settings.mode == TriggerSettings::Mode::Auto && m_state == State::Armed && m_shown
        && now - m_since > Patience) {
        m_shown.reset();
        return true;
    }
    return false;
}

} // namespace dynascope
