// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracepaths.h"

#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <array>
#include <utility>

namespace dynascope {

namespace {

/// A polyline cut off at the upper and the lower edge: drawings know no clipping.
class ClippedLine
{
public:
    explicit ClippedLine(const QRectF &area) : m_area(area) { }

    void moveTo(QPointF to)
    {
        m_at = to;
        m_isPenDown = false;
    }
    void lineTo(QPointF to)
    {
        const QPointF from = std::exchange(m_at, to);
        if (std::max(from.y(), to.y()) < m_area.top() || std::min(from.y(), to.y()) > m_area.bottom()) {
            m_isPenDown = false;
            return;
        }
        const QPointF begin = inside(from, to);
        if (!m_isPenDown || begin != from)
            path.moveTo(begin);
        const QPointF end = inside(to, from);
        path.lineTo(end);
        m_isPenDown = end == to;
    }

    QPainterPath path;

private:
    /// `end` of a line, moved along it to the edge that it is beyond.
    QPointF inside(QPointF end, QPointF other) const
    {
        const qreal y = std::clamp(end.y(), m_area.top(), m_area.bottom());
        return y == end.y() ? end : QPointF(end.x() + (other.x() - end.x()) * (y - end.y()) / (other.y() - end.y()), y);
    }

    QRectF m_area;
    QPointF m_at;
    bool m_isPenDown = false;
};

} // namespace

void paintPaths(QPainter &painter, std::span<const TraceData> traces, const PlotScales &scales, const TimeView &view,
    const QRectF &area)
{
    painter.save();
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
        ClippedLine line(area);
        bool isFirst = true;
        for (std::size_t i = 0; i < columns.size() && view.step * (view.firstColumn + static_cast<std::int64_t>(i)) <= view.until; ++i) {
            const History::Column &column = columns[i];
            if (column.isEmpty)
                continue;
            const qreal x = area.left() + (static_cast<double>(i) + 0.5) / view.columns * area.width();
            if (std::exchange(isFirst, false) || column.gapBefore)
                line.moveTo({x, y(column.first)});
            else
                line.lineTo({x, y(column.first)});
            if (column.minimum != column.maximum) {
                line.lineTo({x, y(column.minimum)});
                line.lineTo({x, y(column.maximum)});
                line.lineTo({x, y(column.last)});
            }
        }
        QPen pen(trace->color, 1.5, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
        static constexpr std::array Styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine};
        pen.setStyle(Styles[static_cast<std::size_t>(std::clamp(trace->dash, 0, 3))]);
        painter.setPen(pen);
        painter.setOpacity(trace->dimmed ? 0.35 : 1);
        painter.drawPath(line.path);
    }
    painter.restore();
}

} // namespace dynascope
