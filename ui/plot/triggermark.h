// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/axisscaler.h"
#include "ui/plot/tracedata.h"

#include <QPalette>
#include <QRectF>

class QPainter;

namespace dynascope {

/// How a chart shows it.
struct TriggerMark {
    bool isOn = false;
    bool isShown = false; ///< the view stands, and its zero is the moment
    QString unit;         ///< of the axis on which the level is; with no unit where it is an event
    bool hasLevel = false;
    double level = 0;
    QString text;         ///< "Waiting: rising through 180 °"

    /// The level, and, where the view stands, the moment. `range` is that of the level's axis.
    void paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette,
               const AxisRange *range) const;

    friend bool operator==(const TriggerMark &, const TriggerMark &) = default;
};

} // namespace dynascope
