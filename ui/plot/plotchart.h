// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/chartframe.h"
#include "ui/plot/plotscales.h"
#include "ui/plot/timewindow.h"
#include "ui/plot/traceimage.h"

#include <QWidget>

namespace dynascope {

/// One coordinate system with its traces. Shows what it is given; the time it shows is its owner's.
class PlotChart : public QWidget
{
    Q_OBJECT

public:
    /// `window` outlives this.
    explicit PlotChart(const TimeWindow &window, QWidget *parent = nullptr);
    ~PlotChart() override;

    /// The histories must stay until the next call.
    void setTraces(std::vector<TraceData> traces);
    const std::vector<TraceData> &traces() const { return m_traces; }
    void setEmphasized(int trace); ///< drawn stronger and on top; −1: none
    /// The newest sample of all plots: the right edge while live.
    void setNewest(LineTime newest);
    void setAutoscale(bool on);
    bool isAutoscale() const { return m_autoscale; }
    /// Room for labels left and right: several charts below each other keep it alike, so that their times stand in
    /// line.
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
    void zoomed(double factor, dynascope::LineTime around); ///< paused
    void panned(dynascope::LineTime by);
    void autoscaleChanged(bool on); ///< the person zoomed values
    void fitRequested();            ///< double click

protected:
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
    void changeEvent(QEvent *event) override;

private:
    LabelColumns labelRoom() const;
    ChartFrame::Content frameContent(const TimeView &view) const;
    void paintEmpty(QPainter &painter, const QRectF &area);
    void paintTraces(QPainter &painter, const TimeView &view, const QRectF &area);
    void zoomValues(int steps, qreal y);
    void zoomTime(int steps, qreal x); ///< positive: closer

    const TimeWindow &m_window;
    std::vector<TraceData> m_traces;
    PlotScales m_scales;
    ChartFrame m_frame;
    TraceImage m_image;
    LineTime m_newest{};
    QString m_emptyText;
    int m_emphasized = -1;
    bool m_autoscale = true;
    bool m_marked = false;
    LabelColumns m_labelRoom;
    bool m_showFocus = false; ///< it came by key
    std::optional<QPointF> m_cursor;
    std::optional<QPointF> m_dragFrom;
    int m_wheelRest = 0; ///< eighths of a degree that don't make a step yet
};

} // namespace dynascope
