// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/tracedata.h"

#include <QPalette>
#include <QRectF>

#include <array>

class QPainter;

namespace dynascope {

/// The two cursors of all panels. They stand at places of the time axis: live, the values run through under them; paused,
/// each is a moment.
struct PlotCursors {
    bool isOn = false;
    std::array<LineTime, 2> at{}; ///< from the view's zero: A, B
    int active = 0;               ///< the one that keys move

    static QString name(int which); ///< "A", "B"
    LineTime distance() const { return at[1] - at[0]; }
    LineTime earlier() const { return std::min(at[0], at[1]); }
    LineTime later() const { return std::max(at[0], at[1]); }
    QString distanceText() const; ///< "Δt 1.250 s · 0.800 Hz"

    /// The cursor that a mouse at `x` takes hold of; −1: none.
    int near(qreal x, const TimeView &view, const QRectF &area) const;
    void paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette) const;

    friend bool operator==(const PlotCursors &, const PlotCursors &) = default;
};

} // namespace dynascope
