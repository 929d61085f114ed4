// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracecolors.h"

#include <algorithm>

namespace dynascope {

namespace {

constexpr int Hues = 8;
constexpr int Patterns = 4;
constexpr int Colors = Hues * Patterns;

/// Is it the same trace, whatever it looks like?
bool isSame(PlotState::Trace one, const PlotState::Trace &other)
{
    one.color = other.color;
    one.visible = other.visible;
    return one == other;
}

} // namespace

PlotState::Trace *TraceColors::find(const TraceKey &key)
{
    const std::optional<PlotState::Trace> wanted = PlotState::Trace::of(key, m_session);
    if (!wanted)
        return nullptr;
    const auto at = std::ranges::find_if(
        m_remembered, [&wanted](const PlotState::Trace &trace) { return isSame(trace, *wanted); });
    return at == m_remembered.end() ? nullptr : &*at;
}

bool TraceColors::isShownByAnother(int color, const TraceKey &key) const
{
    return std::ranges::any_of(
        m_shown, [&](const Shown &shown) { return shown.color == color && shown.key != key; });
}

int TraceColors::take(const TraceKey &key)
{
    const auto shown = std::ranges::find(m_shown, key, &Shown::key);
    if (shown != m_shown.end()) {
        ++shown->count;
        return shown->color;
    }
    const PlotState::Trace *known = find(key);
    int color = known ? known->color : -1;
    if (color < 0 || isShownByAnother(color, key)) {
        const auto isRemembered = [this](int of) {
            return std::ranges::find(m_remembered, of, &PlotState::Trace::color) != m_remembered.end();
        };
        color = 0;
        while (color < Hues && (isShownByAnother(color, key) || isRemembered(color)))
            ++color;
        if (color == Hues) // all of the first have been somebody's: then the first that is free
            for (color = 0; color < Colors && isShownByAnother(color, key);)
                ++color;
        if (color == Colors) // more than can be told apart
            color = static_cast<int>(m_shown.size()) % Colors;
    }
    m_shown.push_back({key, color, 1});
    remember(key, color);
    return color;
}

void TraceColors::release(const TraceKey &key)
{
    const auto shown = std::ranges::find(m_shown, key, &Shown::key);
    if (shown != m_shown.end() && --shown->count == 0)
        m_shown.erase(shown);
}

void TraceColors::remember(const TraceKey &key, int color)
{
    const auto shown = std::ranges::find(m_shown, key, &Shown::key);
    if (shown != m_shown.end())
        shown->color = color;
    if (PlotState::Trace *known = find(key)) {
        known->color = color;
        return;
    }
    std::optional<PlotState::Trace> trace = PlotState::Trace::of(key, m_session);
    if (!trace)
        return;
    trace->color = color;
    if (m_remembered.size() == Most)
        m_remembered.erase(m_remembered.begin());
    m_remembered.push_back(*std::move(trace));
}

void TraceColors::restore(const std::vector<PlotState::Trace> &remembered)
{
    m_remembered = remembered;
    if (m_remembered.size() > Most)
        m_remembered.resize(Most);
}

int dashOf(int color)
{
    return std::max(0, color) / Hues % Patterns;
}

bool traceInk(int dash, std::int64_t column, int pixelRatio)
{
    if (dash == 0)
        return true;
    const std::int64_t pixel = column / std::max(pixelRatio, 1);
    switch (dash) {
    case 1: return pixel % 12 < 8;
    case 2: return pixel % 5 < 2;
    default: {
        const std::int64_t at = pixel % 16;
        return at < 8 || (at >= 11 && at < 13);
    }
    }
}

} // namespace dynascope
