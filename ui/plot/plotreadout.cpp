// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotreadout.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/plot/timeticks.h"

#include <QCoreApplication>
#include <QPainter>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int MostReadoutRows = 12;
constexpr qreal ReadoutPadding = 8;
constexpr qreal Swatch = 10;

struct Row {
    const TraceData *trace;
    double value;
};

QString timeText(const TimeView &view, LineTime at)
{
    const auto seconds = [&view](LineTime time) { return std::chrono::duration<double>(time - view.zero).count(); };
    const double step = view.step < std::chrono::milliseconds(1) ? 1e-4 : 1e-2;
    return timeLabel(seconds(at), step, {seconds(view.from()), seconds(view.to())});
}

} // namespace

const History::Sample *PlotReadout::sampleAt(const History &history, LineTime at, History::Sample &storage)
{
    const std::size_t after = history.indexAt(at + LineTime(1));
    if (after == 0 || (after < history.size() && history.gapBefore(after)))
        return nullptr;
    storage = history.at(after - 1);
    return &storage;
}

void PlotReadout::paint(QPainter &painter) const
{
    const ThemeColors &theme = colors(palette);
    const LineTime at = view.timeAt((x - area.left()) / area.width() * view.columns);
    painter.setPen(QPen(theme.dimmed, 1, Qt::DashLine));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));

    std::vector<Row> rows;
    painter.setRenderHint(QPainter::Antialiasing);
    for (const TraceData &trace : traces) {
        History::Sample sample;
        if (!trace.isDrawn() || !sampleAt(*trace.history, at, sample))
            continue;
        const AxisRange &range = scales.range(trace.unit);
        rows.push_back({&trace, trace.value(sample.raw)});
        const qreal y = area.bottom() - (rows.back().value - range.minimum) / range.span() * area.height();
        if (y < area.top() || y > area.bottom())
            continue;
        painter.setPen(QPen(palette.color(QPalette::Base), 1.5));
        painter.setBrush(trace.color);
        painter.drawEllipse(QPointF(x, y), 4, 4);
    }
    const int more = std::max(0, static_cast<int>(rows.size()) - MostReadoutRows);
    rows.resize(std::min<std::size_t>(rows.size(), MostReadoutRows));

    const QFont numbers = numberFont(painter.font());
    const QFontMetricsF text(painter.font());
    const QFontMetricsF digits(numbers);
    const qreal line = std::ceil(text.height() + 3);
    qreal names = text.horizontalAdvance(timeText(view, at));
    qreal values = 0;
    qreal units = 0;
    for (const Row &row : rows) {
        names = std::max(
            names, std::min<qreal>(text.horizontalAdvance(row.trace->shortLabel()), std::min(240.0, area.width() * 0.4)));
        values = std::max(values, digits.horizontalAdvance(withMinus(QString::number(row.value, 'f', row.trace->decimals))));
        units = std::max(units, text.horizontalAdvance(row.trace->unit));
    }
    const qreal width = 5 * ReadoutPadding + Swatch + names + values + units;
    const qreal height = line * (static_cast<qreal>(rows.size()) + 1 + (more > 0 ? 1 : 0)) + ReadoutPadding;
    const bool isLeft = x + ReadoutPadding + width > area.right();
    const qreal boxLeft = isLeft ? std::max(x - ReadoutPadding - width, area.left() + 2) : x + ReadoutPadding;
    const QRectF box(std::round(boxLeft) + 0.5, area.top() + 8.5, width, height);
    QColor back = palette.color(QPalette::ToolTipBase);
    back.setAlphaF(0.94F);
    painter.setPen(theme.border);
    painter.setBrush(back);
    painter.drawRoundedRect(box, 4, 4);

    QRectF slot(box.left() + ReadoutPadding, box.top() + ReadoutPadding / 2, box.width() - 2 * ReadoutPadding, line);
    painter.setPen(theme.dimmed);
    painter.drawText(slot, Qt::AlignVCenter | Qt::AlignLeft, timeText(view, at));
    for (const Row &row : rows) {
        slot.translate(0, line);
        painter.fillRect(QRectF(slot.left(), slot.center().y() - 1.5, Swatch, 3), row.trace->color);
        painter.setPen(palette.color(QPalette::ToolTipText));
        const QRectF name(slot.left() + Swatch + ReadoutPadding, slot.top(), names, line);
        painter.drawText(
            name, Qt::AlignVCenter | Qt::AlignLeft, text.elidedText(row.trace->shortLabel(), Qt::ElideMiddle, names + 1));
        const QFont font = painter.font();
        painter.setFont(numbers);
        painter.drawText(QRectF(slot.left(), slot.top(), slot.width() - units - ReadoutPadding / 2, line),
            Qt::AlignVCenter | Qt::AlignRight,
            withMinus(QString::number(row.value, 'f', row.trace->decimals)));
        painter.setFont(font);
        painter.setPen(theme.dimmed);
        painter.drawText(
            QRectF(slot.right() - units, slot.top(), units, line), Qt::AlignVCenter | Qt::AlignLeft, row.trace->unit);
    }
    if (more > 0) {
        slot.translate(0, line);
        painter.setPen(theme.dimmed);
        painter.drawText(slot, Qt::AlignVCenter | Qt::AlignLeft,
            QCoreApplication::translate("PlotReadout", "and %n more", nullptr, more));
    }
    painter.setRenderHint(QPainter::Antialiasing, false);
}

} // namespace dynascope
