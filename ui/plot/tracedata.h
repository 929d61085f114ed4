// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/history.h"

#include <QColor>
#include <QString>

namespace dynascope {

/// "Present Position (°)"
inline QString withUnit(const QString &name, const QString &unit)
{
    return unit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, unit);
}

/// All that drawing one trace needs; made anew whenever something of it changes. Knows no device, so that anything with
/// a History can be drawn.
struct TraceData {
    const History *history = nullptr; ///< none: nothing has come yet
    double scale = 1;                 ///< physical = raw × scale + offset, in `unit`
    double offset = 0;
    int decimals = 0;
    QString device, field; ///< what a person calls them
    QString unit; ///< traces of one unit share a value axis
    QColor color;
    int dash = 0; ///< pattern of its line, see traceInk(); 0: none
    bool visible = true;
    bool dimmed = false; ///< its device is gone

    QString label() const { return device.isEmpty() ? field : device + QStringLiteral(" · ") + field; }
    /// "Present Position #1": the field first, and of the device what tells it from others of its model.
    QString shortLabel() const { return device.isEmpty() ? field : field + u' ' + device.mid(std::max<qsizetype>(0, device.lastIndexOf(u'#'))); }
    double value(std::int32_t raw) const { return raw * scale + offset; }
    bool isDrawn() const { return visible && history && !history->isEmpty(); }
};

/// A stretch of time cut into pixel columns. Columns are counted from the clock's zero, so a column keeps its samples
/// while the view moves: nothing flickers, and what was computed once can be kept.
struct TimeView {
    LineTime step{1}; ///< width of a column
    std::int64_t firstColumn = 0;
    int columns = 0;
    LineTime zero{};                  ///< what the time axis calls 0 s
    LineTime until = LineTime::max(); ///< paused: what came later isn't shown

    LineTime from() const { return step * firstColumn; }
    LineTime to() const { return step * (firstColumn + columns); }
    LineTime shownTo() const { return until < to() ? until + LineTime(1) : to(); } ///< exclusive
    double column(LineTime at) const
    {
        return static_cast<double>((at - from()).count()) / static_cast<double>(step.count());
    }
    LineTime timeAt(double column) const
    {
        return from() + LineTime(static_cast<std::int64_t>(column * static_cast<double>(step.count())));
    }

    friend bool operator==(const TimeView &, const TimeView &) = default;
};

} // namespace dynascope
