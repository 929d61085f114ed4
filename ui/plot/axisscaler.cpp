// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/axisscaler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynascope {

double niceStep(double span, int most, bool isAngle)
{
    const double least = span / std::max(most, 1);
    if (!(least > 0) || !std::isfinite(least))
        return 1;
    if (isAngle && least > 10 && least <= 180) {
        for (const double step : {15.0, 30.0, 45.0, 90.0, 180.0}) {
            if (step >= least)
                return step;
        }
    }
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * (1 - 1e-9))
            return factor * power;
    }
    return 10 * power;
}

int decimalsFor(double step)
{
    return step >= 1 ? 0 : std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
}

AxisScaler::AxisScaler(double smallestSpan, bool isAngle) : m_smallestSpan(smallestSpan), m_isAngle(isAngle)
{
    take(0, 1);
}

void AxisScaler::setMostSteps(int most)
{
    if (most == m_mostSteps)
        return;
    m_mostSteps = most;
    take(m_range.minimum, m_range.maximum);
}

void AxisScaler::take(double minimum, double maximum)
{
    const double step = niceStep(maximum - minimum, m_mostSteps, m_isAngle);
    m_range = {minimum, maximum, step, decimalsFor(step)};
    m_looseSince.reset();
}

/// The range for this data: some air, ends at half steps.
AxisRange AxisScaler::around(double low, double high) const
{
    const double missing = m_smallestSpan - (high - low);
    if (missing > 0) {
        low -= missing / 2;
        high += missing / 2;
    }
    const double air = (high - low) * 0.04;
    const double grid = niceStep(high - low + 2 * air, m_mostSteps, m_isAngle) / 2;
    return {std::floor((low - air) / grid) * grid, std::ceil((high + air) / grid) * grid, 0, 0};
}

void AxisScaler::fit(double low, double high, Time now)
{
    if (!std::isfinite(low) || !std::isfinite(high) || high < low)
        return;
    const AxisRange wanted = around(low, high);
    if (!m_fitted) {
        m_fitted = true;
        take(wanted.minimum, wanted.maximum);
        return;
    }
    if (low < m_range.minimum || high > m_range.maximum) {
        // Only the side that was left: the other one, which may still be a little wide, stays.
        const double minimum = low < m_range.minimum ? wanted.minimum : m_range.minimum;
        const double maximum = high > m_range.maximum ? wanted.maximum : m_range.maximum;
        const bool isFar = (maximum - minimum) * ShrinkBelow > wanted.span();
        take(isFar ? wanted.minimum : minimum, isFar ? wanted.maximum : maximum);
        return;
    }
    if (wanted.span() >= m_range.span() * ShrinkBelow) {
        m_looseSince.reset();
        return;
    }
    if (!m_looseSince)
        m_looseSince = now;
    else if (now - *m_looseSince >= Patience)
        take(wanted.minimum, wanted.maximum);
}

void AxisScaler::setRange(double minimum, double maximum)
{
    if (std::isfinite(minimum) && std::isfinite(maximum) && maximum - minimum >= m_smallestSpan / 100)
        take(minimum, maximum);
}

void AxisScaler::zoom(double factor, double around)
{
    setRange(around - (around - m_range.minimum) * factor, around + (m_range.maximum - around) * factor);
}

void AxisScaler::move(double by)
{
    setRange(m_range.minimum + by, m_range.maximum + by);
}

} // namespace dynascope
