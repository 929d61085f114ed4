// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/timeticks.h"

#include "ui/common/texts.h"
#include "ui/plot/axisscaler.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr double Minute = 60, Hour = 60 * Minute;
constexpr double Day = 24 * Hour;
constexpr double LongestInSeconds = 2 * Minute;
constexpr double Slack = 1 + 1e-6; ///< a view is whole columns wide: hardly longer than it was asked to be

struct TimeTicks {
    Q_DECLARE_TR_FUNCTIONS(TimeTicks)
};

/// Two digits before the point.
QString twoDigits(double value, int decimals)
{
    return QString::number(value, 'f', decimals).rightJustified(decimals > 0 ? 3 + decimals : 2, u'0');
}

/// "1:05" of 65 and 60.
QString clockText(double amount, double unit, int decimals)
{
    const double whole = std::floor(amount / unit);
    return QString::number(whole, 'f', 0) + u':' + twoDigits(amount - whole * unit, decimals);
}

} // namespace

double timeStep(const TimeStretch &stretch, int most)
{
    const double least = stretch.span() / std::max(most, 1);
    if (least > 10 * Slack) {
        for (const double step : {15.0, 30.0, Minute, 2 * Minute, 5 * Minute, 10 * Minute, 15 * Minute, 30 * Minute, Hour,
                 2 * Hour, 3 * Hour, 6 * Hour, 12 * Hour, Day}) {
            if (least <= step * Slack)
                return step;
        }
        return std::ceil(least / Slack / Day) * Day;
    }
    return niceStep(stretch.span() / Slack, most);
}

QString timeLabel(double seconds, double step, const TimeStretch &stretch)
{
    const int decimals = decimalsFor(step);
    const double unit = std::pow(10.0, -decimals);
    const double amount = std::round(std::abs(seconds) / unit) * unit; // else 59.99… would become "0:60"
    const QString sign = seconds < 0 && amount > 0 ? withMinus(QStringLiteral("-")) : QString();
    const double farthest = std::max(std::abs(stretch.from), std::abs(stretch.to));
    if (farthest <= LongestInSeconds * Slack)
        return sign + TimeTicks::tr("%1 s").arg(QString::number(amount, 'f', decimals));
    if (farthest <= Hour * Slack) {
        return sign + TimeTicks::tr("%1 min").arg(step < Minute ? clockText(amount, Minute, decimals)
                                                                : QString::number(amount / Minute, 'f', 0));
    }
    if (step >= Hour)
        return sign + TimeTicks::tr("%1 h").arg(QString::number(amount / Hour, 'f', 0));
    if (step >= Minute)
        return sign + TimeTicks::tr("%1 h").arg(clockText(amount / Minute, Minute, 0));
    const double hours = std::floor(amount / Hour);
    const double minutes = std::floor((amount - hours * Hour) / Minute);
    const QString rest = twoDigits(amount - hours * Hour - minutes * Minute, decimals);
    return sign + TimeTicks::tr("%1 h").arg(QString::number(hours, 'f', 0) + u':' + twoDigits(minutes, 0) + u':' + rest);
}

} // namespace dynascope
