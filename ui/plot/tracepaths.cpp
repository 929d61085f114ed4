// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracepaths.h"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <array>

namespace dynascope {

void paintPaths(QPainter &painter, std::span<const TraceData> traces, const PlotScales &scales, const TimeView &view,
    const QRectF &area)
{
    painter.save();
    painter.setClipRect(area);
    painter.setBrush(Qt::NoBrush);
    std::vector<History::Column> columns(static_cast<std::size_t>(view.columns));
    for (auto trace = traces.rbegin(); trace != traces.rend(); ++trace) {
        if (!trace->isDrawn())
            continue;
        trace->history->columns(view.from(), view.to(), columns);
        const AxisRange &range = scales.range(trace->unit);
        const auto y = [&](std::int32_t raw) {
            return area.bottom() - (trace->value(raw) - range.minimum) / range.span() * area.height();
        };
        QPainterPath path;
        for (std::size_t i = 0; i < columns.size() && view.step * (view.firstColumn + static_cast<std::int64_t>(i)) <= view.until; ++i) {
            const History::Column &column = columns[i];
            if (column.isEmpty)
                continue;
            const qreal x = area.left() + (static_cast<double>(i) + 0.5) / view.columns * area.width();
            if (path.isEmpty() || column.gapBefore)
                path.moveTo(x, y(column.first));
            else
                path.lineTo(x, y(column.first));
            if (column.minimum != column.maximum) {
                path.lineTo(x, y(column.minimum));
                path.lineTo(x, y(column.maximum));
                path.lineTo(x, y(column.last));
            }
        }
        QPen pen(trace->color, 1.5, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
        static constexpr std::array Styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine};
        pen.setStyle(Styles[static_cast<std::size_t>(std::clamp(trace->dash, 0, 3))]);
        painter.setPen(pen);
        painter.setOpacity(trace->dimmed ? 0.35 : 1);
        painter.drawPath(path);
    }
    painter.restore();
}

} // namespace dynascope
