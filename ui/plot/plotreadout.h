// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/plotscales.h"

#include <QPalette>

class QPainter;

namespace dynascope {

/// The vertical line under the mouse: its time, a dot on each trace and the values there.
struct PlotReadout {
    std::span<const TraceData> traces;
    const PlotScales &scales;
    const TimeView &view;
    QRectF area; ///< of the plot
    qreal x = 0; ///< of the line
    QPalette palette;

    void paint(QPainter &painter) const;

    /// The sample that held at this moment: the last one not after it, unless nothing is known there.
    static const History::Sample *sampleAt(const History &history, LineTime at, History::Sample &storage);
};

} // namespace dynascope
