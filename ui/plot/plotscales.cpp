// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotscales.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr double SmallestSteps = 10; ///< raw steps that fill the axis at least

} // namespace

void PlotScales::setTraces(std::span<const TraceData> traces)
{
    for (Scale &scale : m_scales)
        scale.isUsed = false;
    for (const TraceData &trace : traces) {
        auto at = std::ranges::find(m_scales, trace.unit, &Scale::unit);
        const double smallest = std::max(std::abs(trace.scale) * SmallestSteps, 1e-6);
        if (at == m_scales.end()) {
            m_scales.push_back({trace.unit, AxisScaler(smallest, trace.unit == QStringLiteral("°")), false, false});
            at = m_scales.end() - 1;
            takeWaiting(*at);
        }
        at->isUsed = at->isUsed || trace.visible;
    }
    std::erase_if(m_scales, [traces](const Scale &scale) {
        return std::ranges::none_of(traces, [&scale](const TraceData &trace) { return trace.unit == scale.unit; });
    });
}

void PlotScales::takeWaiting(Scale &scale)
{
    const auto at = std::ranges::find(m_waiting, scale.unit, &Waiting::unit);
    if (at == m_waiting.end())
        return;
    scale.isByHand = true;
    scale.scaler.setRange(at->minimum, at->maximum);
    m_waiting.erase(at);
}

void PlotScales::setMostSteps(int most)
{
    for (Scale &scale : m_scales)
        scale.scaler.setMostSteps(most);
}

void PlotScales::fit(std::span<const TraceData> traces, const TimeView &view, LineTime now)
{
    for (Scale &scale : m_scales) {
        if (scale.isByHand)
            continue;
        double low = 0;
        double high = 0;
        bool isFound = false;
        for (const TraceData &trace : traces) {
            std::int32_t least = 0;
            std::int32_t most = 0;
            if (trace.unit != scale.unit || !trace.isDrawn()
                || !trace.history->range(view.from(), std::min(view.to(), view.until), least, most))
                continue;
            const double one = trace.value(least);
            const double other = trace.value(most);
            low = isFound ? std::min({low, one, other}) : std::min(one, other);
            high = isFound ? std::max({high, one, other}) : std::max(one, other);
            isFound = true;
        }
        if (isFound)
            scale.scaler.fit(low, high, now);
    }
}

void PlotScales::setByHand(bool byHand)
{
    for (Scale &scale : m_scales) {
        if (scale.isByHand && !byHand)
            scale.scaler.refit();
        scale.isByHand = byHand;
    }
    if (!byHand)
        m_waiting.clear();
}

bool PlotScales::isAnyByHand() const
{
    return std::ranges::any_of(m_scales, &Scale::isByHand);
}

void PlotScales::setRange(const QString &unit, double minimum, double maximum)
{
    const auto at = std::ranges::find(m_scales, unit, &Scale::unit);
    if (at == m_scales.end()) {
        std::erase_if(m_waiting, [&unit](const Waiting &waiting) { return waiting.unit == unit; });
        m_waiting.push_back({unit, minimum, maximum});
        return;
    }
    at->isByHand = true;
    at->scaler.setRange(minimum, maximum);
}

const AxisRange &PlotScales::range(const QString &unit) const
{
    static const AxisRange none;
    const auto at = std::ranges::find(m_scales, unit, &Scale::unit);
    return at == m_scales.end() ? none : at->scaler.range();
}

std::vector<PlotScales::Scale *> PlotScales::of(int side)
{
    std::vector<Scale *> chosen;
    const Scale *one = labelled(side);
    for (Scale &scale : m_scales) {
        if (side < 0 || &scale == one)
            chosen.push_back(&scale);
    }
    return chosen;
}

const PlotScales::Scale *PlotScales::labelled(int side) const
{
    for (const Scale &scale : m_scales) {
        if (scale.isUsed && side-- == 0)
            return &scale;
    }
    return nullptr;
}

} // namespace dynascope
