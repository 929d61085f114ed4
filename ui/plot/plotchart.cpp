// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotchart.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/plot/plotreadout.h"

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr int StepHeight = 44; ///< pixels between value labels, at least
constexpr int WheelStep = 120;
constexpr double WheelZoom = 1.25;

double seconds(LineTime time)
{
    return std::chrono::duration<double>(time).count();
}

} // namespace

PlotChart::PlotChart(const TimeWindow &window, QWidget *parent) : QWidget(parent), m_window(window)
{
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
}

PlotChart::~PlotChart() = default;

void PlotChart::setTraces(std::vector<TraceData> traces)
{
    m_traces = std::move(traces);
    m_scales.setTraces(m_traces);
    update();
}

void PlotChart::setEmphasized(int trace)
{
    if (trace == m_emphasized)
        return;
    m_emphasized = trace;
    update();
}

void PlotChart::setNewest(LineTime newest)
{
    m_newest = newest;
    update();
}

void PlotChart::setAutoscale(bool on)
{
    if (on == m_autoscale)
        return;
    m_autoscale = on;
    if (on)
        m_scales.refit();
    update();
}

LabelColumns PlotChart::labelColumns() const
{
    LabelColumns columns{m_scales.labelled(0) ? 1 : 0, 0};
    while (columns.right < ChartFrame::MostAxes - 1 && m_scales.labelled(columns.right + 1))
        ++columns.right;
    return columns;
}

void PlotChart::setLabelRoom(LabelColumns room)
{
    if (room == m_labelRoom)
        return;
    m_labelRoom = room;
    update();
}

LabelColumns PlotChart::labelRoom() const
{
    return labelColumns().unitedWith(m_labelRoom);
}

void PlotChart::setEmptyText(const QString &text)
{
    m_emptyText = text;
    update();
}

void PlotChart::setMarked(bool marked)
{
    m_marked = marked;
    update();
}

QRectF PlotChart::plotArea() const
{
    ChartFrame::Content content;
    content.size = size();
    content.pixelRatio = devicePixelRatioF();
    content.font = font();
    content.room = labelRoom();
    return ChartFrame::plotArea(content);
}

TimeView PlotChart::view() const
{
    return m_window.view(static_cast<int>(std::lround(plotArea().width() * devicePixelRatioF())), m_newest);
}

ChartFrame::Content PlotChart::frameContent(const TimeView &view) const
{
    ChartFrame::Content content;
    content.size = size();
    content.pixelRatio = devicePixelRatioF();
    content.font = font();
    content.palette = palette();
    content.fromSeconds = seconds(view.from() - view.zero);
    content.toSeconds = seconds(view.to() - view.zero);
    content.room = labelRoom();
    for (std::size_t i = 0; i < content.values.size(); ++i) {
        if (const PlotScales::Scale *scale = m_scales.labelled(static_cast<int>(i)))
            content.values[i] = {scale->unit, scale->scaler.range(), true};
    }
    return content;
}

void PlotChart::paintTraces(QPainter &painter, const TimeView &view, const QRectF &area)
{
    const auto ratio = static_cast<float>(devicePixelRatioF());
    std::vector<TraceImage::Item> items;
    items.reserve(m_traces.size());
    for (const TraceData &trace : m_traces)
        items.push_back({&trace, &m_scales.range(trace.unit), 1.5F * ratio});
    if (m_emphasized >= 0 && m_emphasized < static_cast<int>(items.size())) {
        items[static_cast<std::size_t>(m_emphasized)].thickness = 2.5F * ratio;
        items[static_cast<std::size_t>(m_emphasized)].isOnTop = true;
    }
    const int height = static_cast<int>(std::lround(area.height() * devicePixelRatioF()));
    painter.drawImage(area, m_image.paint(items, view, height));
}

void PlotChart::paintEmpty(QPainter &painter, const QRectF &area)
{
    const QColor color = colors(palette()).dimmed;
    constexpr qreal IconSize = 32;
    const QRectF text =
        painter.boundingRect(area.adjusted(24, 8, -24, -8), Qt::AlignCenter | Qt::TextWordWrap, m_emptyText);
    painter.fillRect(text.adjusted(-16, -8, 16, 8), palette().color(QPalette::Base)); // no grid through the words
    painter.setPen(color);
    painter.drawText(text, Qt::AlignCenter | Qt::TextWordWrap, m_emptyText);
    const QRectF icon(area.center().x() - IconSize / 2, text.top() - IconSize - 16, IconSize, IconSize);
    if (icon.top() > area.top())
        paintIcon(&painter, icon, QStringLiteral("chart"), color);
}

void PlotChart::paintEvent(QPaintEvent *)
{
    const QRectF area = plotArea();
    const TimeView now = view();
    m_scales.setMostSteps(std::max(2, static_cast<int>(area.height() / StepHeight)));
    if (m_autoscale)
        m_scales.fit(m_traces, now, m_newest);
    QPainter painter(this);
    painter.drawPixmap(0, 0, m_frame.pixmap(frameContent(now)));
    if (m_traces.empty()) {
        painter.setPen(colors(palette()).dimmed);
        paintEmpty(painter, area);
    } else {
        paintTraces(painter, now, area);
    }
    if (m_cursor && !m_dragFrom && area.contains(*m_cursor))
        PlotReadout{m_traces, m_scales, now, area, m_cursor->x(), palette()}.paint(painter);
    if (m_marked || m_showFocus) {
        painter.setPen(QPen(colors(palette()).accent, m_marked ? 2 : 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(area);
    }
}

void PlotChart::mouseMoveEvent(QMouseEvent *event)
{
    m_cursor = event->position();
    if (m_dragFrom && !m_window.isLive()) {
        const TimeView now = view();
        const double columns = (m_dragFrom->x() - event->position().x()) / plotArea().width() * now.columns;
        emit panned(LineTime(std::llround(columns * static_cast<double>(now.step.count()))));
        const double up = (event->position().y() - m_dragFrom->y()) / plotArea().height();
        if (!m_autoscale) {
            for (PlotScales::Scale &scale : m_scales.scales())
                scale.scaler.move(up * scale.scaler.range().span());
        }
        m_dragFrom = event->position();
    }
    update();
}

void PlotChart::mousePressEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton) {
        QWidget::mousePressEvent(event);
        return;
    }
    if (m_window.isLive())
        return;
    m_dragFrom = event->position();
    setCursor(Qt::ClosedHandCursor);
}

void PlotChart::mouseReleaseEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton)
        return;
    m_dragFrom.reset();
    unsetCursor();
    update();
}

void PlotChart::mouseDoubleClickEvent(QMouseEvent *)
{
    emit fitRequested();
}

void PlotChart::zoomValues(int steps, qreal y)
{
    const double factor = std::pow(WheelZoom, -steps);
    const QRectF area = plotArea();
    if (m_autoscale) {
        m_autoscale = false;
        emit autoscaleChanged(false);
    }
    for (PlotScales::Scale &scale : m_scales.scales()) {
        const AxisRange &range = scale.scaler.range();
        scale.scaler.zoom(factor, range.minimum + (area.bottom() - y) / area.height() * range.span());
    }
    update();
}

void PlotChart::zoomTime(int steps, qreal x)
{
    if (m_window.isLive()) {
        emit spanStepped(-steps);
        return;
    }
    const TimeView now = view();
    const QRectF area = plotArea();
    emit zoomed(std::pow(WheelZoom, -steps), now.timeAt((x - area.left()) / area.width() * now.columns));
}

void PlotChart::wheelEvent(QWheelEvent *event)
{
    event->accept();
    m_wheelRest += event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
    const int steps = m_wheelRest / WheelStep;
    m_wheelRest -= steps * WheelStep;
    if (steps == 0)
        return;
    if (event->modifiers().testFlag(Qt::ControlModifier))
        zoomValues(steps, event->position().y());
    else
        zoomTime(steps, event->position().x());
}

void PlotChart::keyPressEvent(QKeyEvent *event)
{
    const QPointF centre = plotArea().center();
    const bool values = event->modifiers().testFlag(Qt::ControlModifier);
    const LineTime tenth = (view().to() - view().from()) / 10;
    switch (event->key()) {
    case Qt::Key_Left: emit panned(-tenth); return;
    case Qt::Key_Right: emit panned(tenth); return;
    case Qt::Key_Plus:
    case Qt::Key_Equal: values ? zoomValues(1, centre.y()) : zoomTime(1, centre.x()); return;
    case Qt::Key_Minus: values ? zoomValues(-1, centre.y()) : zoomTime(-1, centre.x()); return;
    case Qt::Key_Home: emit fitRequested(); return;
    default: QWidget::keyPressEvent(event);
    }
}

void PlotChart::focusInEvent(QFocusEvent *event)
{
    m_showFocus = event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason
        || event->reason() == Qt::ShortcutFocusReason;
    update();
}

void PlotChart::focusOutEvent(QFocusEvent *)
{
    m_showFocus = false;
    update();
}

void PlotChart::leaveEvent(QEvent *)
{
    m_cursor.reset();
    update();
}

void PlotChart::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange)
        update();
    QWidget::changeEvent(event);
}

} // namespace dynascope
