// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/triggermark.h"

#include "ui/common/theme.h"
#include "ui/plot/plotmarks.h"

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace dynascope {

void TriggerMark::paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette,
                        const AxisRange *range) const
{
    if (!isOn)
        return;
    painter.setPen(QPen(colors(palette).warning, 1, Qt::DashLine));
    if (range) {
        const qreal y = std::round(area.bottom() - (level - range->minimum) / range->span() * area.height());
        if (y >= area.top() && y <= area.bottom())
            painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    }
    if (isShown) {
        const qreal x = std::round(area.left() + view.column(view.zero) / view.columns * area.width());
        if (x >= area.left() && x <= area.right())
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    }
    if (text.isEmpty())
        return;
    const QFontMetricsF metrics(painter.font());
    const qreal button = isShown ? 160 : 16; // the way back to live stands beside it then
    const QString said = metrics.elidedText(text, Qt::ElideRight, std::max(40.0, area.width() - button));
    const QRectF box(area.left() + 4, area.top() + PlotMarks::Size + 4, metrics.horizontalAdvance(said) + 8,
                     metrics.height() + 2);
    painter.fillRect(box, palette.color(QPalette::Base));
    painter.setPen(colors(palette).dimmed);
    painter.drawText(box, Qt::AlignCenter, said);
}

} // namespace dynascope
