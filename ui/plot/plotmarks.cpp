// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotmarks.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QPainter>
#include <QPolygonF>

#include <cmath>

namespace dynascope {

namespace {

constexpr int MostLines = 12; ///< of one tip

QColor colorOf(LoggedEvent::Kind kind, const ThemeColors &theme)
{
    switch (kind) {
    case LoggedEvent::Kind::Restart: return theme.bad;
    case LoggedEvent::Kind::Alert: return theme.warning;
    case LoggedEvent::Kind::TorqueOn: return theme.good;
    case LoggedEvent::Kind::TorqueOff: return theme.dimmed;
    case LoggedEvent::Kind::Write: break;
    }
    return theme.accent;
}

void paintShape(QPainter &painter, LoggedEvent::Kind kind, const QRectF &box)
{
    const QPointF centre = box.center();
    switch (kind) {
    case LoggedEvent::Kind::Restart:
        painter.drawPolygon(QPolygonF{{QPointF(centre.x(), box.top()), QPointF(box.right(), centre.y()),
            QPointF(centre.x(), box.bottom()), QPointF(box.left(), centre.y())}});
        break;
    case LoggedEvent::Kind::Alert:
        painter.drawRect(QRectF(centre.x() - 1.5, box.top(), 3, box.height() * 0.6));
        painter.drawRect(QRectF(centre.x() - 1.5, box.bottom() - 2.5, 3, 2.5));
        break;
    case LoggedEvent::Kind::TorqueOn: painter.drawPolygon(QPolygonF{{box.bottomLeft(), box.bottomRight(), QPointF(centre.x(), box.top())}}); break;
    case LoggedEvent::Kind::TorqueOff: painter.drawPolygon(QPolygonF{{box.topLeft(), box.topRight(), QPointF(centre.x(), box.bottom())}}); break;
    case LoggedEvent::Kind::Write: painter.drawRect(box.adjusted(1.5, 1.5, -1.5, -1.5)); break;
    }
}

} // namespace

/// Those in sight, with their places, from the newest on.
template <typename Visit>
void PlotMarks::each(const TimeView &view, const QRectF &area, Visit visit) const
{
    if (!log)
        return;
    const std::deque<LoggedEvent> &events = log->events();
    for (std::size_t i = log->indexAt(view.shownTo()); i-- > 0 && events[i].at >= view.from();) {
        if (events[i].device == 0 || devices.contains(events[i].device))
            visit(events[i], std::round(area.left() + view.column(events[i].at) / view.columns * area.width()));
    }
}

void PlotMarks::paint(QPainter &painter, const TimeView &view, const QRectF &area, const QPalette &palette) const
{
    const ThemeColors &theme = colors(palette);
    qreal last = area.right() + 2 * Size;
    each(view, area, [&](const LoggedEvent &event, qreal x) {
        if (last - x < 2) // they would only hide each other; the tip names all
            return;
        last = x;
        const QColor color = colorOf(event.kind, theme);
        QColor line = color;
        line.setAlphaF(0.35F);
        painter.setPen(QPen(line, 1, Qt::DotLine));
        painter.drawLine(QPointF(x, area.top() + Size), QPointF(x, area.bottom()));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(palette.color(QPalette::Base), 1));
        painter.setBrush(color);
        paintShape(painter, event.kind, QRectF(x - Size / 2, area.top() + 1, Size, Size));
        painter.setRenderHint(QPainter::Antialiasing, false);
    });
    painter.setBrush(Qt::NoBrush);
}

QString PlotMarks::textAt(const QPointF &at, const TimeView &view, const QRectF &area) const
{
    if (at.y() < area.top() - 2 || at.y() > area.top() + 2 * Size)
        return {};
    QStringList lines;
    each(view, area, [&](const LoggedEvent &event, qreal x) {
        if (std::abs(x - at.x()) > Size / 2 + 2)
            return;
        const double seconds = std::chrono::duration<double>(event.at - view.zero).count();
        lines.prepend(QStringLiteral("%1 s · %2 · %3").arg(withMinus(QString::number(seconds, 'f', 3)), event.name, event.text));
    });
    while (lines.size() > MostLines)
        lines.removeFirst();
    return lines.join(u'\n');
}

} // namespace dynascope
