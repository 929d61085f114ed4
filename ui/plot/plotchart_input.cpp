// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotchart.h"

#include "ui/common/texts.h"

#include <QApplication>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>

#include <cmath>
#include <utility>

namespace dynascope {

namespace {

constexpr int WheelStep = 120;
constexpr double WheelZoom = 1.25;
constexpr qreal DragZoom = 60;  ///< pixels along an axis that zoom it by e
constexpr qreal SmallestBox = 6;
constexpr qreal LevelGrip = 4;  ///< so near to the trigger's level it is taken hold of

} // namespace

LineTime PlotChart::timeAt(qreal x) const
{
    const TimeView now = view();
    const QRectF area = plotArea();
    return now.timeAt((x - area.left()) / area.width() * now.columns);
}

bool PlotChart::isAtLevel(const QPointF &at) const
{
    if (!m_trigger.isOn || !m_trigger.hasLevel)
        return false;
    const QRectF area = plotArea();
    const AxisRange &range = m_scales.range(m_trigger.unit);
    const qreal y = area.bottom() - (m_trigger.level - range.minimum) / range.span() * area.height();
    return area.contains(at) && std::abs(at.y() - y) <= LevelGrip;
}

int PlotChart::axisAt(const QPointF &at) const
{
    const QRectF area = plotArea();
    if (at.y() > area.bottom())
        return -1;
    if (at.x() < area.left())
        return m_scales.labelled(0) ? 0 : -1;
    if (at.x() <= area.right() || labelRoom().right == 0)
        return -1;
    const int right = std::max(1, static_cast<int>(std::lround((width() - area.right()) / ChartFrame::columnWidth(font()))));
    const int axis = 1 + std::min(right - 1, static_cast<int>((at.x() - area.right()) / ChartFrame::columnWidth(font())));
    return m_scales.labelled(axis) ? axis : -1;
}

void PlotChart::zoomValues(int steps, qreal y, int axis)
{
    const double factor = std::pow(WheelZoom, -steps);
    const QRectF area = plotArea();
    for (PlotScales::Scale *scale : m_scales.of(axis)) {
        const AxisRange &range = scale->scaler.range();
        scale->isByHand = true;
        scale->scaler.zoom(factor, range.minimum + (area.bottom() - y) / area.height() * range.span());
    }
    emit autoscaleChanged(false);
    update();
}

void PlotChart::moveValues(qreal pixels, int axis)
{
    for (PlotScales::Scale *scale : m_scales.of(axis)) {
        if (scale->isByHand) // what follows the data stays there
            scale->scaler.move(pixels / plotArea().height() * scale->scaler.range().span());
    }
}

void PlotChart::zoomTime(int steps, qreal x)
{
    if (m_window->isLive())
        emit spanStepped(-steps);
    else
        emit zoomed(std::pow(WheelZoom, -steps), timeAt(x));
}

void PlotChart::zoomToBox(const QRectF &box)
{
    if (box.width() < SmallestBox || box.height() < SmallestBox)
        return;
    const QRectF area = plotArea();
    const LineTime from = timeAt(box.left());
    const LineTime to = timeAt(box.right());
    for (PlotScales::Scale *scale : m_scales.of(-1)) {
        const AxisRange range = scale->scaler.range();
        const auto valueAt
            = [&](qreal y) { return range.minimum + (area.bottom() - y) / area.height() * range.span(); };
        scale->isByHand = true;
        scale->scaler.setRange(valueAt(box.bottom()), valueAt(box.top()));
    }
    emit autoscaleChanged(false);
    emit timesChosen(from, to);
}

void PlotChart::beginDrag(Drag drag, const QPointF &at)
{
    m_drag = drag;
    m_dragFrom = at;
    m_dragLast = at;
    m_wasMoved = false;
}

bool PlotChart::event(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange)
        update();
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    const auto *help = static_cast<QHelpEvent *>(event);
    const QString text = m_marks.textAt(help->pos(), view(), plotArea());
    if (text.isEmpty())
        QToolTip::hideText();
    else
        QToolTip::showText(help->globalPos(), plainToolTip(text), this);
    return true;
}

void PlotChart::mousePressEvent(QMouseEvent *event)
{
    const QPointF at = event->position();
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) {
        QWidget::mousePressEvent(event);
        return;
    }
    const QRectF area = plotArea();
    const int cursor = m_cursors.near(at.x(), view(), area);
    const bool isInside = area.contains(at);
    if (isInside && !m_traces.empty() && event->modifiers().testFlag(Qt::ShiftModifier)) {
        if (m_window->isLive())
            emit pauseRequested();
        beginDrag(Drag::Box, at);
    } else if (isInside && cursor >= 0) {
        m_dragged = cursor;
        beginDrag(Drag::Cursor, at);
    } else if (isAtLevel(at)) {
        beginDrag(Drag::Level, at);
    } else if (const int axis = axisAt(at); axis >= 0) {
        m_dragged = axis;
        beginDrag(Drag::Values, at);
    } else if (!isInside && at.y() > area.bottom()) {
        beginDrag(Drag::Times, at);
    } else if (isInside) {
        beginDrag(Drag::Pan, at);
    }
    showDragShape(at, event->modifiers());
}

void PlotChart::dragTo(const QPointF &at)
{
    const QRectF area = plotArea();
    const QPointF moved = at - m_dragLast;
    switch (m_drag) {
    case Drag::Pan: {
        if (m_window->isLive())
            return;
        const TimeView now = view();
        const double columns = -moved.x() / area.width() * now.columns;
        emit panned(LineTime(std::llround(columns * static_cast<double>(now.step.count()))));
        moveValues(moved.y());
        break;
    }
    case Drag::Cursor: placeCursor(m_dragged, at); break;
    case Drag::Level: {
        const AxisRange &range = m_scales.range(m_trigger.unit);
        const qreal y = std::clamp(at.y(), area.top(), area.bottom());
        m_trigger.level = range.minimum + (area.bottom() - y) / area.height() * range.span();
        break;
    }
    case Drag::Values: { // up: closer, around the middle
        for (PlotScales::Scale *scale : m_scales.of(m_dragged)) {
            const AxisRange &range = scale->scaler.range();
            scale->isByHand = true;
            scale->scaler.zoom(std::exp(moved.y() / DragZoom), range.minimum + range.span() / 2);
        }
        emit autoscaleChanged(false);
        break;
    }
    case Drag::Times: // to the right: closer, where it was taken hold of
        if (m_window->isLive())
            emit pauseRequested();
        emit zoomed(std::exp(-moved.x() / DragZoom), timeAt(std::clamp(m_dragFrom.x(), area.left(), area.right())));
        break;
    case Drag::Box:
    case Drag::None: break;
    }
    m_dragLast = at;
}

void PlotChart::mouseMoveEvent(QMouseEvent *event)
{
    m_mouse = event->position();
    if (m_drag != Drag::None) {
        m_wasMoved = m_wasMoved
            || (event->position() - m_dragFrom).manhattanLength() >= QApplication::startDragDistance();
        if (m_wasMoved || m_drag != Drag::Times)
            dragTo(event->position());
    }
    showDragShape(event->position(), event->modifiers());
    update();
}

void PlotChart::mouseReleaseEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton)
        return;
    const Drag drag = m_drag;
    m_drag = Drag::None;
    m_cursorBefore.reset();
    if (drag == Drag::Level && m_wasMoved)
        emit triggerLevelChosen(m_trigger.level);
    else if (drag == Drag::Box)
        zoomToBox(QRectF(m_dragFrom, event->position()).normalized().intersected(plotArea()));
    else if (drag == Drag::Pan && !m_wasMoved && m_cursors.isOn && event->button() == Qt::LeftButton) {
        m_cursorBefore = m_cursors.at[static_cast<std::size_t>(m_cursors.active)];
        placeCursor(m_cursors.active, event->position());
    }
    showDragShape(event->position(), event->modifiers());
    update();
}

/// What a press here would do.
void PlotChart::showDragShape(const QPointF &at, Qt::KeyboardModifiers modifiers)
{
    const QRectF area = plotArea();
    const bool isInside = area.contains(at);
    if (m_drag == Drag::Box || (m_drag == Drag::None && isInside && modifiers.testFlag(Qt::ShiftModifier)))
        setCursor(Qt::CrossCursor);
    else if (m_drag == Drag::Cursor || (m_drag == Drag::None && isInside && m_cursors.near(at.x(), view(), area) >= 0))
        setCursor(Qt::SplitHCursor);
    else if (m_drag == Drag::Pan && !m_window->isLive())
        setCursor(Qt::ClosedHandCursor);
    else if (m_drag == Drag::Level || m_drag == Drag::Values
             || (m_drag == Drag::None && (isAtLevel(at) || axisAt(at) >= 0)))
        setCursor(Qt::SizeVerCursor);
    else if (m_drag == Drag::Times || (m_drag == Drag::None && at.y() > area.bottom()))
        setCursor(Qt::SizeHorCursor);
    else
        unsetCursor();
}

void PlotChart::mouseDoubleClickEvent(QMouseEvent *event)
{
    const int axis = axisAt(event->position());
    for (PlotScales::Scale *scale : m_scales.of(axis)) {
        scale->isByHand = false;
        scale->scaler.refit();
    }
    m_drag = Drag::None;
    if (m_cursorBefore) // the first click was none for a cursor
        emit cursorMoved(m_cursors.active, *std::exchange(m_cursorBefore, {}));
    if (axis < 0)
        emit fitRequested();
    else
        emit autoscaleChanged(isAutoscale());
    update();
}

void PlotChart::wheelEvent(QWheelEvent *event)
{
    event->accept();
    m_wheelRest += event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
    const int steps = m_wheelRest / WheelStep;
    m_wheelRest -= steps * WheelStep;
    if (steps == 0)
        return;
    const int axis = axisAt(event->position());
    if (axis >= 0 || event->modifiers().testFlag(Qt::ControlModifier))
        zoomValues(steps, event->position().y(), axis);
    else
        zoomTime(steps, event->position().x());
}

void PlotChart::placeCursor(int which, const QPointF &at)
{
    const QRectF area = plotArea();
    emit cursorMoved(which, timeAt(std::clamp(at.x(), area.left(), area.right())) - view().zero);
}

void PlotChart::moveCursor(int columns)
{
    const LineTime at = m_cursors.at[static_cast<std::size_t>(m_cursors.active)];
    emit cursorMoved(m_cursors.active, at + view().step * columns);
}

void PlotChart::keyPressEvent(QKeyEvent *event)
{
    const QPointF centre = plotArea().center();
    const QPointF place = m_mouse && plotArea().contains(*m_mouse) ? *m_mouse : centre;
    const bool ctrl = event->modifiers().testFlag(Qt::ControlModifier);
    const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
    const LineTime tenth = (view().to() - view().from()) / 10;
    const bool movesCursor = shift && m_cursors.isOn;
    switch (event->key()) {
    case Qt::Key_Left: movesCursor ? moveCursor(ctrl ? -20 : -1) : emit panned(-tenth); return;
    case Qt::Key_Right: movesCursor ? moveCursor(ctrl ? 20 : 1) : emit panned(tenth); return;
    case Qt::Key_Plus:
    case Qt::Key_Equal: ctrl ? zoomValues(1, centre.y()) : zoomTime(1, centre.x()); return;
    case Qt::Key_Minus: ctrl ? zoomValues(-1, centre.y()) : zoomTime(-1, centre.x()); return;
    case Qt::Key_Home: emit fitRequested(); return;
    case Qt::Key_A:
    case Qt::Key_B:
        if (event->modifiers() != Qt::NoModifier)
            break;
        placeCursor(event->key() == Qt::Key_A ? 0 : 1, place);
        return;
    case Qt::Key_C:
        if (event->modifiers() != Qt::NoModifier)
            break;
        emit cursorsToggled();
        return;
    default: break;
    }
    QWidget::keyPressEvent(event);
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
    m_mouse.reset();
    update();
}

} // namespace dynascope
