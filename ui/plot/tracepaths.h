// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/plotscales.h"
#include "ui/plot/tracedata.h"

#include <QRectF>

class QPainter;

namespace dynascope {

/// Traces as lines instead of pixels, for a drawing. The first lies on top. From the lowest to the
/// highest value of each column, and on to the next: no more than what is seen, however many samples there are.
void paintPaths(QPainter &painter, std::span<const TraceData> traces, const PlotScales &scales, const TimeView &view,
    const QRectF &area);

} // namespace dynascope
