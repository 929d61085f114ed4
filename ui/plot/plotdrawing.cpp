// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotdrawing.h"

#include "ui/common/theme.h"
#include "ui/plot/measuremodel.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"

#include <QPainter>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int LegendMargin = 12, LegendSwatch = 12, LegendGap = 8, LegendAir = 4;

/// Below a chart: a row for each trace in sight, or the table of figures with its header.
struct Legend {
    struct Row {
        QColor color; ///< invalid: the header
        QStringList texts;
    };
    std::vector<Row> rows;

    explicit Legend(const PlotPanel &panel)
    {
        if (const MeasureModel *figures = panel.figures(); figures && figures->rowCount() > 0) {
            Row header;
            for (int column = 0; column < figures->columnCount(); ++column)
                header.texts << figures->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
            rows.push_back(header);
            for (int row = 0; row < figures->rowCount(); ++row) {
                Row one{figures->index(row, 0).data(Qt::DecorationRole).value<QColor>(), {}};
                for (int column = 0; column < figures->columnCount(); ++column)
                    one.texts << figures->index(row, column).data().toString();
                rows.push_back(one);
            }
            return;
        }
        for (const TraceData &trace : panel.chart().traces()) {
            if (trace.visible)
                rows.push_back({trace.color, {withUnit(trace.label(), trace.unit)}});
        }
    }

    int lineHeight(const QFontMetrics &metrics) const { return metrics.height() + LegendAir; }
    int height(const QFontMetrics &metrics) const
    {
        return static_cast<int>(rows.size()) * lineHeight(metrics) + (rows.empty() ? 0 : 2 * LegendGap);
    }

    std::vector<int> widths(const QFontMetrics &metrics) const
    {
        std::vector<int> all;
        for (const Row &row : rows) {
            all.resize(std::max(all.size(), static_cast<std::size_t>(row.texts.size())));
            for (qsizetype i = 0; i < row.texts.size(); ++i)
                all[static_cast<std::size_t>(i)] = std::max(all[static_cast<std::size_t>(i)], metrics.horizontalAdvance(row.texts[i]));
        }
        return all;
    }
    int width(const QFontMetrics &metrics) const
    {
        int sum = 2 * LegendMargin + LegendSwatch + LegendGap;
        for (const int each : widths(metrics))
            sum += each + 2 * LegendGap;
        return sum;
    }

    void paint(QPainter &painter, int top, const QPalette &palette) const
    {
        const QFontMetrics metrics(painter.font());
        const std::vector<int> columns = widths(metrics);
        int y = top + LegendGap;
        for (const Row &row : rows) {
            const QRect line(LegendMargin, y, LegendSwatch, lineHeight(metrics));
            if (row.color.isValid())
                painter.fillRect(line.adjusted(0, line.height() / 2 - 2, 0, -line.height() / 2 + 2), row.color);
            painter.setPen(row.color.isValid() ? palette.color(QPalette::Text) : colors(palette).dimmed);
            int x = LegendMargin + LegendSwatch + LegendGap;
            for (qsizetype i = 0; i < row.texts.size(); ++i) {
                const int width = columns[static_cast<std::size_t>(i)];
                painter.drawText(QRect(x, y, width + 1, line.height()), (i == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter, row.texts[i]);
                x += width + 2 * LegendGap;
            }
            y += line.height();
        }
    }
};

} // namespace

QSize PlotDrawing::size() const
{
    QSize size(0, 0);
    for (const PlotPanel *panel : m_panels) {
        const Legend legend(*panel);
        const QFontMetrics metrics(numberFont(panel->font()));
        size.rwidth() = std::max({size.width(), panel->chart().width(), legend.width(metrics)});
        size.rheight() += panel->chart().height() + legend.height(metrics);
    }
    return size;
}

void PlotDrawing::paint(QPainter &painter) const
{
    const QSize whole = size();
    int y = 0;
    for (const PlotPanel *panel : m_panels) {
        PlotChart &chart = panel->chart();
        const Legend legend(*panel);
        painter.setFont(numberFont(panel->font()));
        const int below = legend.height(QFontMetrics(painter.font()));
        painter.fillRect(QRect(0, y, whole.width(), chart.height() + below), panel->palette().color(QPalette::Window));
        chart.render(&painter, QPoint(0, y), {}, QWidget::DrawWindowBackground);
        legend.paint(painter, y + chart.height(), panel->palette());
        y += chart.height() + below;
    }
}

} // namespace dynascope
