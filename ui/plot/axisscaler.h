// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <optional>

namespace dynascope {

/// The range of a value axis, which begins and ends anywhere, and its labelled steps.
struct AxisRange {
    double minimum = 0;
    double maximum = 1;
    double step = 0.2; ///< between labels, which stand at multiples of it
    int decimals = 1;  ///< that the labels need

    double span() const { return maximum - minimum; }
    friend bool operator==(const AxisRange &, const AxisRange &) = default;
};

/// The smallest of 1, 2, 5 × 10ⁿ that cuts `span` into at most `most` steps. Above 10°, angles step by 15, 30,
/// 45, 90...
double niceStep(double span, int most, bool isAngle = false);
/// So many decimals tell multiples of `step` apart.
int decimalsFor(double step);

/// Decides what a value axis shows. Follows data that leaves the range at once, and data that fills little of it only
/// after a while, so that the axis stands still under a signal that breathes.
class AxisScaler
{
public:
    using Time = std::chrono::nanoseconds;

    /// `smallestSpan`: no closer than this, so that one step of a resting value doesn't fill the plot.
    explicit AxisScaler(double smallestSpan = 1, bool isAngle = false);

    void setMostSteps(int most);
    void setSmallestSpan(double span) { m_smallestSpan = span; }
    const AxisRange &range() const { return m_range; }

    /// The data seen at `now` spans [low, high].
    void fit(double low, double high, Time now);
    void refit() { m_fitted = false; } ///< the next fit() starts afresh
    /// By hand; fit() is not called meanwhile.
    void setRange(double minimum, double maximum);
    void zoom(double factor, double around);
    void move(double by);

    static constexpr Time Patience = std::chrono::milliseconds(1200);
    static constexpr double ShrinkBelow = 0.6; ///< part of the present span

private:
    AxisRange around(double low, double high) const;
    void take(double minimum, double maximum);

    double m_smallestSpan;
    bool m_isAngle;
    int m_mostSteps = 6;
    bool m_fitted = false;
    AxisRange m_range;
    std::optional<Time> m_looseSince;
};

} // namespace dynascope
