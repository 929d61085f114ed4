// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotcursors.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QCoreApplication>
#include <QPainter>

#include <cmath>

namespace dynascope {

namespace {

constexpr qreal Reach = 5; ///< pixels beside a line at which it is taken hold of
constexpr qreal Padding = 4;

qreal placeOf(LineTime at, const TimeView &view, const QRectF &area)
{
    return area.left() + view.column(view.zero + at) / std::max(view.columns, 1) * area.width();
}

} // namespace

QString PlotCursors::name(int which)
{
    return which == 0 ? QStringLiteral("A") : QStringLiteral("B");
}

QString PlotCursors::distanceText() const
{
    const double seconds = std::abs(std::chrono::duration<double>(distance()).count());
    const QString time = QCoreApplication::translate("PlotCursors", "Δt %1 s").arg(QString::number(seconds, 'f', 4));
    if (!(seconds > 0))
        return time;
    const double hertz = 1 / seconds;
    const int decimals = hertz >= 100 ? 1 : hertz >= 10 ? 2 : 3;
    return QCoreApplication::translate("PlotCursors", "%1 · %2 Hz").arg(time, QString::number(hertz, 'f', decimals));
}

int PlotCursors::near(qreal x, const TimeView &view, const QRectF &area) const
{
    if (!isOn)
        return -1;
    const qreal a = std::abs(placeOf(at[0], view, area) - x);
    const qreal b = std::abs(placeOf(at[1], view, area) - x);
    if (std::min(a, b) > Reach)
        return -1;
    return a == b ? active : a < b ? 0 : 1;
}

void PlotCursors::paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette) const
{
    if (!isOn)
        return;
    const ThemeColors &theme = colors(palette);
    const qreal ends[]{placeOf(at[0], view, area), placeOf(at[1], view, area)};
    QColor between = theme.accent;
    between.setAlphaF(0.06F);
    painter.fillRect(QRectF(QPointF(std::min(ends[0], ends[1]), area.top()),
                         QPointF(std::max(ends[0], ends[1]), area.bottom()))
                         .intersected(area),
        between);
    const QFontMetricsF metrics(painter.font());
    const qreal height = metrics.height() + 2;
    for (int i = 0; i < 2; ++i) {
        const qreal x = std::round(ends[i]);
        const bool isOutside = x < area.left() || x > area.right();
        painter.setPen(QPen(theme.accent, i == active ? 1.5 : 1, i == 0 ? Qt::SolidLine : Qt::DashLine));
        if (!isOutside)
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        // Its tag lies at the lower edge, clear of the read-out; of one that is out of sight, at that side.
        const QString text = !isOutside ? name(i)
            : x < area.left()           ? QStringLiteral("‹ ") + name(i)
                                        : name(i) + QStringLiteral(" ›");
        const qreal width = metrics.horizontalAdvance(text) + 2 * Padding;
        QRectF tag(x - width / 2, area.bottom() - height - i * (height + 1), width, height);
        tag.moveLeft(std::clamp(tag.left(), area.left(), std::max(area.left(), area.right() - width)));
        painter.fillRect(tag, theme.accent);
        painter.setPen(palette.color(QPalette::Base));
        painter.drawText(tag, Qt::AlignCenter, text);
    }
}

} // namespace dynascope
