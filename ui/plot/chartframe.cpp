// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/chartframe.h"

#include "ui/common/theme.h"

#include <QChart>
#include <QCoreApplication>
#include <QFontMetricsF>
#include <QGraphicsLayout>
#include <QGraphicsScene>
#include <QLineSeries>
#include <QPainter>
#include <QValueAxis>

#include <cmath>

namespace dynascope {

namespace {

constexpr int MostTimeSteps = 10;
constexpr int Margin = 8;

/// Seconds step as clocks do: 10, 15, 30 s, then minutes.
double niceSeconds(double span, int most)
{
    if (span / most > 10) {
        for (const double step : {15.0, 30.0, 60.0, 120.0}) {
            if (span / most <= step)
                return step;
        }
    }
    return niceStep(span, most);
}

/// Every change lays the labels out, and a small step over a wide range makes thousands: widen the step first.
void setRange(QValueAxis *axis, double minimum, double maximum, double step)
{
    if (axis->tickInterval() < step)
        axis->setTickInterval(step);
    // Labels are added up from the first one, and zero may come out as "-0": a hair more, and it doesn't.
    const double hair = step * 1e-6;
    axis->setTickAnchor(hair);
    axis->setRange(minimum, maximum + 2 * hair);
    axis->setTickInterval(step);
}

QString labelFormat(int decimals, const QString &unit)
{
    return QStringLiteral("%.%1f%2").arg(decimals).arg(unit.isEmpty() ? unit : u' ' + unit);
}

} // namespace

ChartFrame::ChartFrame() : m_scene(std::make_unique<QGraphicsScene>()), m_chart(new QChart), m_time(new QValueAxis)
{
    m_scene->addItem(m_chart);
    m_chart->legend()->hide();
    m_chart->setBackgroundVisible(false);
    m_chart->setMargins({});
    m_chart->layout()->setContentsMargins(0, 0, 0, 0);
    m_chart->addAxis(m_time, Qt::AlignBottom);
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        m_values[i] = new QValueAxis;
        m_chart->addAxis(m_values[i], i == 0 ? Qt::AlignLeft : Qt::AlignRight);
        auto *series = new QLineSeries; // an axis without a series isn't laid out
        m_chart->addSeries(series);
        series->attachAxis(m_time);
        series->attachAxis(m_values[i]);
    }
    for (QValueAxis *axis : {m_time, m_values[0], m_values[1]}) {
        axis->setTickType(QValueAxis::TicksDynamic);
        axis->setLineVisible(axis == m_time);
        axis->setMinorGridLineVisible(false);
        axis->setTruncateLabels(false);
    }
    m_values[1]->setGridLineVisible(false); // one grid: the left axis'
}

ChartFrame::~ChartFrame() = default;

QRectF ChartFrame::plotArea(const Content &content)
{
    const QFontMetricsF metrics(content.font);
    const qreal labels = metrics.horizontalAdvance(QStringLiteral("-0000.00")) + Margin;
    const qreal left = content.hasRoom[0] ? labels : Margin;
    const qreal right = content.hasRoom[1] ? labels : 2.0 * Margin;
    const qreal top = metrics.height() + 1.5 * Margin;
    const qreal bottom = metrics.height() + 1.5 * Margin;
    const auto whole = [&content](qreal value) { return std::round(value * content.pixelRatio) / content.pixelRatio; };
    const qreal width = std::max(1.0, content.size.width() - left - right);
    const qreal height = std::max(1.0, content.size.height() - top - bottom);
    return {whole(left), whole(top), whole(width), whole(height)};
}

void ChartFrame::applyColors(const Content &content)
{
    const ThemeColors &theme = colors(content.palette);
    for (QValueAxis *axis : {m_time, m_values[0], m_values[1]}) {
        axis->setLabelsFont(content.font);
        axis->setLabelsBrush(theme.dimmed);
        axis->setLinePen(QPen(theme.border));
        axis->setGridLinePen(QPen(theme.grid));
    }
}

void ChartFrame::applyRanges(const Content &content)
{
    const double seconds = niceSeconds(content.toSeconds - content.fromSeconds, MostTimeSteps);
    setRange(m_time, content.fromSeconds, content.toSeconds, seconds);
    m_time->setLabelFormat(labelFormat(decimalsFor(seconds), QStringLiteral("s")));
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        const ValueAxis &value = content.values[i];
        m_values[i]->setVisible(value.isUsed);
        setRange(m_values[i], value.range.minimum, value.range.maximum, value.range.step);
        m_values[i]->setLabelFormat(labelFormat(value.range.decimals, {}));
    }
    m_values[0]->setGridLineVisible(content.values[0].isUsed);
}

const QPixmap &ChartFrame::pixmap(const Content &content)
{
    if (content == m_content && !m_pixmap.isNull())
        return m_pixmap;
    if (m_pixmap.isNull() || content.palette != m_content.palette || content.font != m_content.font)
        applyColors(content);
    m_content = content;
    m_chart->resize(content.size);
    m_chart->setPlotArea(plotArea(content));
    applyRanges(content);
    m_chart->layout()->activate();

    m_pixmap = QPixmap(content.size * content.pixelRatio);
    m_pixmap.setDevicePixelRatio(content.pixelRatio);
    m_pixmap.fill(content.palette.color(QPalette::Window));
    QPainter painter(&m_pixmap);
    const QRectF area = plotArea(content);
    painter.fillRect(area, content.palette.color(QPalette::Base));
    const QRectF whole(QPointF(), content.size);
    m_scene->render(&painter, whole, whole);
    painter.setFont(content.font);
    const ThemeColors &theme = colors(content.palette);
    painter.setPen(theme.border);
    painter.drawRect(area.adjusted(0, 0, -1, -1));
    painter.setPen(theme.dimmed);
    const QRectF above(area.left(), 0, area.width(), area.top() - 3);
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        if (content.values[i].isUsed)
            painter.drawText(
                above, Qt::AlignBottom | (i == 0 ? Qt::AlignLeft : Qt::AlignRight), content.values[i].title);
    }
    return m_pixmap;
}

} // namespace dynascope
