// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/chartframe.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/plot/timeticks.h"

#include <QChart>
#include <QFontMetricsF>
#include <QGraphicsLayout>
#include <QGraphicsScene>
#include <QLineSeries>
#include <QPainter>
#include <QValueAxis>

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr int MostTimeSteps = 10;
constexpr qreal LabelGap = 14; ///< between the labels of two times
constexpr int Margin = 8;

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

/// The multiples of `step` from `low` to `high`.
template <typename Paint>
void eachStep(double low, double high, double step, Paint paint)
{
    constexpr int Most = 100;
    if (step <= 0)
        return;
    const double first = std::ceil(low / step - 1e-6);
    for (int i = 0; i < Most && (first + i) * step <= high + step * 1e-6; ++i)
        paint((first + i) * step);
}

QString labelText(double value, int decimals)
{
    const QString text = withMinus(QString::number(value, 'f', decimals));
    const bool isZero = std::abs(value) < 0.5 * std::pow(10.0, -decimals); // else "−0.0"
    return isZero ? QString::number(0.0, 'f', decimals) : text;
}

/// The step of the time axis whose labels stand clear of each other.
double labelledStep(const ChartFrame::Content &content)
{
    const TimeStretch stretch{content.fromSeconds, content.toSeconds};
    const QFontMetricsF metrics(content.font);
    const qreal room = ChartFrame::plotArea(content).width();
    for (int most = MostTimeSteps; most > 1; --most) {
        const double step = timeStep(stretch, most);
        qreal widest = 0;
        for (const double at : {stretch.from, stretch.to})
            widest = std::max(widest, metrics.horizontalAdvance(timeLabel(at, step, stretch)));
        if (widest + LabelGap <= step / stretch.span() * room)
            return step;
    }
    return timeStep(stretch, 1);
}

/// As many as leave the traces room; one always.
int rightColumns(const ChartFrame::Content &content)
{
    constexpr int LeastPlot = 110;
    const qreal column = ChartFrame::columnWidth(content.font);
    const qreal free = content.size.width() - content.room.left * column - LeastPlot;
    return std::min(content.room.right, std::max(1, static_cast<int>(free / column)));
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
        axis->setLabelsVisible(false);
    }
    m_values[1]->setGridLineVisible(false); // one grid: the left axis'
}

ChartFrame::~ChartFrame() = default;

qreal ChartFrame::columnWidth(const QFont &font)
{
    return QFontMetricsF(font).horizontalAdvance(QStringLiteral("-0000.00")) + Margin;
}

QRectF ChartFrame::plotArea(const Content &content)
{
    const QFontMetricsF metrics(content.font);
    const qreal labels = columnWidth(content.font);
    const qreal left = content.room.left > 0 ? labels : Margin;
    const qreal right = content.room.right > 0 ? rightColumns(content) * labels : 2.0 * Margin;
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
        axis->setLinePen(QPen(theme.border));
        axis->setGridLinePen(QPen(theme.grid));
    }
}

void ChartFrame::applyRanges(const Content &content, double seconds)
{
    setRange(m_time, content.fromSeconds, content.toSeconds, seconds);
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        const ValueAxis &value = content.values[i];
        m_values[i]->setVisible(value.isUsed);
        setRange(m_values[i], value.range.minimum, value.range.maximum, value.range.step);
    }
    m_values[0]->setGridLineVisible(content.values[0].isUsed);
}

const QPixmap &ChartFrame::pixmap(const Content &content)
{
    if (content == m_content && !m_pixmap.isNull())
        return m_pixmap;
    m_pixmap = QPixmap(content.size * content.pixelRatio);
    m_pixmap.setDevicePixelRatio(content.pixelRatio);
    QPainter painter(&m_pixmap);
    draw(painter, content);
    return m_pixmap;
}

void ChartFrame::paint(QPainter &painter, const Content &content)
{
    m_pixmap = {}; // it was of other content, perhaps
    draw(painter, content);
}

void ChartFrame::draw(QPainter &painter, const Content &content)
{
    if (!m_isColored || content.palette != m_content.palette || content.font != m_content.font)
        applyColors(content);
    m_isColored = true;
    m_content = content;
    m_chart->resize(content.size);
    if (const QRectF now = plotArea(content); now != m_area) {
        m_area = now;
        m_chart->setPlotArea(now);
        // Now, or an axis whose range stays the same would leave its grid where it was.
        m_chart->layout()->invalidate();
        m_chart->layout()->activate();
    }
    const double seconds = labelledStep(content); // between the labels of the time axis
    applyRanges(content, seconds);
    m_chart->layout()->activate();

    const QRectF area = plotArea(content);
    const QRectF whole(QPointF(), content.size);
    painter.fillRect(whole, content.palette.color(QPalette::Window));
    painter.fillRect(area, content.palette.color(QPalette::Base));
    m_scene->render(&painter, whole, whole);
    painter.setFont(content.font);
    const ThemeColors &theme = colors(content.palette);
    painter.setPen(theme.border);
    painter.drawRect(area.adjusted(0, 0, -1, -1));
    painter.setPen(theme.dimmed);
    paintTimes(painter, content, seconds);
    for (int axis = 0; axis < MostAxes; ++axis)
        paintValues(painter, content, axis);
}

void ChartFrame::paintTimes(QPainter &painter, const Content &content, double step)
{
    const QRectF area = plotArea(content);
    const double span = content.toSeconds - content.fromSeconds;
    eachStep(content.fromSeconds, content.toSeconds, step, [&](double at) {
        const QString text = timeLabel(at, step, {content.fromSeconds, content.toSeconds});
        const qreal x = area.left() + (at - content.fromSeconds) / span * area.width();
        const qreal width = QFontMetricsF(content.font).horizontalAdvance(text);
        const qreal left = std::clamp(x - width / 2, 0.0, std::max(0.0, content.size.width() - width));
        painter.drawText(QRectF(left, area.bottom() + 3, width + 1, content.size.height() - area.bottom() - 3),
                         Qt::AlignTop | Qt::AlignLeft | Qt::TextDontClip, text);
    });
}

void ChartFrame::paintValues(QPainter &painter, const Content &content, int axis)
{
    constexpr qreal Gap = 4;
    const ValueAxis &value = content.values[static_cast<std::size_t>(axis)];
    if (!value.isUsed || axis > rightColumns(content))
        return;
    const QRectF area = plotArea(content);
    const qreal column = columnWidth(content.font);
    const qreal line = QFontMetricsF(content.font).height();
    const int side = axis == 0 ? Qt::AlignRight : Qt::AlignLeft;
    const qreal left = axis == 0 ? 0 : area.right() + Gap + (axis - 1) * column;
    const qreal width = axis == 0 ? area.left() - Gap : column - Gap;
    eachStep(value.range.minimum, value.range.maximum, value.range.step, [&](double at) {
        const qreal y = area.bottom() - (at - value.range.minimum) / value.range.span() * area.height();
        painter.drawText(QRectF(left, y - line / 2, width, line), Qt::AlignVCenter | side | Qt::TextDontClip,
                         labelText(at, value.range.decimals));
    });
    // Above its column, clear of the topmost number; all axes have it at the same height.
    const qreal room = QFontMetricsF(content.font).horizontalAdvance(value.title) + 1;
    const QRectF above(axis == 0 ? std::max(0.0, width - room) : left, 1, std::max(column, room), line);
    painter.drawText(above, Qt::AlignBottom | Qt::AlignLeft | Qt::TextDontClip, value.title);
}

} // namespace dynascope
