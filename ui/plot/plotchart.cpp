// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotchart.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/plot/plotreadout.h"
#include "ui/plot/tracepaths.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr int StepHeight = 44; ///< pixels between value labels, at least

double seconds(LineTime time)
{
    return std::chrono::duration<double>(time).count();
}

/// Where a replay stands, in what it has not come to yet and what it has behind it.
void paintPlayhead(QPainter &painter, LineTime at, const TimeView &view, const QRectF &area, const QPalette &palette)
{
    const qreal x = std::round(area.left() + view.column(at) / view.columns * area.width());
    if (x < area.left() || x > area.right())
        return;
    constexpr qreal Head = 5;
    const QColor color = colors(palette).accent;
    painter.setPen(QPen(color, 1));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    painter.setBrush(color);
    painter.drawPolygon(QPolygonF{{QPointF(x - Head, area.bottom()), QPointF(x + Head, area.bottom()), QPointF(x, area.bottom() - Head)}});
    painter.setBrush(Qt::NoBrush);
}

void paintBox(QPainter &painter, const QRectF &box, const QPalette &palette)
{
    const QColor line = colors(palette).accent;
    QColor fill = line;
    fill.setAlphaF(0.12F);
    painter.setPen(QPen(line, 1));
    painter.setBrush(fill);
    painter.drawRect(box);
    painter.setBrush(Qt::NoBrush);
}

} // namespace

PlotChart::PlotChart(const TimeWindow &window, QWidget *parent) : QWidget(parent), m_window(&window)
{
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
}

PlotChart::~PlotChart() = default;

void PlotChart::setWindow(const TimeWindow &window)
{
    m_window = &window;
    update();
}

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
    m_scales.setByHand(!on);
    update();
}

void PlotChart::setAxisRange(const QString &unit, double minimum, double maximum)
{
    m_scales.setRange(unit, minimum, maximum);
    update();
}

void PlotChart::setCursors(const PlotCursors &cursors)
{
    if (cursors == m_cursors)
        return;
    m_cursors = cursors;
    update();
}

void PlotChart::setTrigger(const TriggerMark &trigger)
{
    if (trigger == m_trigger || m_drag == Drag::Level)
        return;
    m_trigger = trigger;
    update();
}

void PlotChart::setPlayhead(LineTime at)
{
    m_playhead = at;
    if (!m_window->isLive())
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
    return m_window->view(static_cast<int>(std::lround(plotArea().width() * devicePixelRatioF())), m_newest);
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
        items.push_back({&trace, &m_scales.range(trace.unit), 1.5F * ratio, false, static_cast<int>(std::lround(ratio))});
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
    m_scales.fit(m_traces, now, m_newest);
    QPainter painter(this);
    if (m_isVector)
        m_frame.paint(painter, frameContent(now));
    else
        painter.drawPixmap(0, 0, m_frame.pixmap(frameContent(now)));
    if (m_traces.empty()) {
        painter.setPen(colors(palette()).dimmed);
        paintEmpty(painter, area);
    } else {
        m_isVector ? paintPaths(painter, m_traces, m_scales, now, area) : paintTraces(painter, now, area);
    }
    m_marks.paint(painter, now, area, palette());
    m_trigger.paint(painter, now, area, palette(), m_trigger.hasLevel ? &m_scales.range(m_trigger.unit) : nullptr);
    if (m_playhead && !m_window->isLive())
        paintPlayhead(painter, *m_playhead, now, area, palette());
    m_cursors.paint(painter, now, area, palette());
    if (m_drag == Drag::Box)
        paintBox(painter, QRectF(m_dragFrom, m_dragLast).normalized().intersected(area), palette());
    if (m_mouse && m_drag == Drag::None && area.contains(*m_mouse))
        PlotReadout{m_traces, m_scales, now, area, m_mouse->x(), palette()}.paint(painter);
    if (m_marked || m_showFocus) {
        painter.setPen(QPen(colors(palette()).accent, m_marked ? 2 : 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(area);
    }
}

} // namespace dynascope
