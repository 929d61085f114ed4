// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/chartframe.h"
#include "ui/plot/plotcursors.h"
#include "ui/plot/plotmarks.h"
#include "ui/plot/plotscales.h"
#include "ui/plot/timewindow.h"
#include "ui/plot/traceimage.h"
#include "ui/plot/triggermark.h"

#include <QWidget>

namespace dynascope {

/// One coordinate system with its traces. Shows what it is given; the time it shows is its owner's.
class PlotChart : public QWidget
{
    Q_OBJECT

public:
    /// `window` outlives this, or what setWindow() is given instead.
    explicit PlotChart(const TimeWindow &window, QWidget *parent = nullptr);
    ~PlotChart() override;
    void setWindow(const TimeWindow &window);

    /// The histories must stay until the next call.
    void setTraces(std::vector<TraceData> traces);
    const std::vector<TraceData> &traces() const { return m_traces; }
    void setEmphasized(int trace); ///< drawn stronger and on top; −1: none
    /// The newest sample of all plots: the right edge while live.
    void setNewest(LineTime newest);
    /// On: every axis follows what is seen. Off: all stay as they are.
    void setAutoscale(bool on);
    bool isAutoscale() const { return !m_scales.isAnyByHand(); }
    void setAxisRange(const QString &unit, double minimum, double maximum); ///< by hand
    void setCursors(const PlotCursors &cursors);
    void setTrigger(const TriggerMark &trigger);
    void setPlayhead(LineTime at); ///< a replay stands there: marked in a view that is paused
    void setMarks(const PlotMarks &marks) { m_marks = marks; }
    void setVector(bool on) { m_isVector = on; } ///< painted in lines, not in pixels: for a drawing
    /// Room for labels left and right: kept alike by charts below each other, so that their times stand in line.
    LabelColumns labelColumns() const;
    void setLabelRoom(LabelColumns room);
    void setEmptyText(const QString &text);
    void setMarked(bool marked); ///< outlined: a drop would go here
    const PlotScales &scales() const { return m_scales; }
    TimeView view() const;
    QRectF plotArea() const;
    QSize sizeHint() const override { return {480, 240}; }
    QSize minimumSizeHint() const override { return {160, 96}; }

signals:
    void spanStepped(int steps);                            ///< live: the wheel; positive is longer
    void pauseRequested();                                  ///< live: what follows is of a view that stands
    void zoomed(double factor, dynascope::LineTime around); ///< paused
    void panned(dynascope::LineTime by);
    void timesChosen(dynascope::LineTime from, dynascope::LineTime to); ///< paused: by a box
    void autoscaleChanged(bool on);                                     ///< the person zoomed values
    void fitRequested();                                                ///< double click
    void cursorMoved(int which, dynascope::LineTime at);                ///< from the view's zero
    void cursorsToggled();
    void triggerLevelChosen(double level); ///< dragged there, in the unit of its axis

protected:
    bool event(QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    void leaveEvent(QEvent *event) override;

private:
    enum class Drag { None, Pan, Box, Cursor, Level, Times, Values };

    LabelColumns labelRoom() const;
    ChartFrame::Content frameContent(const TimeView &view) const;
    void paintEmpty(QPainter &painter, const QRectF &area);
    void paintTraces(QPainter &painter, const TimeView &view, const QRectF &area);
    int axisAt(const QPointF &at) const; ///< whose labels are there; −1: none's
    void zoomValues(int steps, qreal y, int axis = -1);
    void moveValues(qreal pixels, int axis = -1);
    void zoomTime(int steps, qreal x); ///< positive: closer
    void zoomToBox(const QRectF &box);
    void beginDrag(Drag drag, const QPointF &at);
    void dragTo(const QPointF &at);
    void showDragShape(const QPointF &at, Qt::KeyboardModifiers modifiers);
    LineTime timeAt(qreal x) const;
    bool isAtLevel(const QPointF &at) const; ///< the trigger's
    void placeCursor(int which, const QPointF &at);
    void moveCursor(int columns);

    const TimeWindow *m_window;
    std::vector<TraceData> m_traces;
    PlotScales m_scales;
    ChartFrame m_frame;
    TraceImage m_image;
    LineTime m_newest{};
    QString m_emptyText;
    int m_emphasized = -1;
    LabelColumns m_labelRoom;
    bool m_isVector = false, m_marked = false, m_showFocus = false; ///< the focus came by key
    PlotCursors m_cursors;
    TriggerMark m_trigger;
    std::optional<LineTime> m_playhead, m_cursorBefore; ///< the latter: where a click has just moved it from
    PlotMarks m_marks;
    std::optional<QPointF> m_mouse;
    Drag m_drag = Drag::None;
    int m_dragged = -1; ///< cursor or axis
    QPointF m_dragFrom, m_dragLast;
    bool m_wasMoved = false; ///< more than a click
    int m_wheelRest = 0; ///< eighths of a degree that don't make a step yet
};

} // namespace dynascope
