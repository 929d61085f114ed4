// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "ui/plot/timewindow.h"

#include <QFrame>

class QBoxLayout;
class QToolButton;

namespace dynascope {

class PlotChart;
class TraceList;
class TraceModel;

/// A chart with the list of its traces beside it, or below where it is narrow. A drop target for fields.
class PlotPanel : public QFrame
{
    Q_OBJECT

public:
    PlotPanel(Session &session, const Monitor &monitor, const TimeWindow &window, QWidget *parent = nullptr);
    ~PlotPanel() override;

    TraceModel &model() const { return *m_model; }
    PlotChart &chart() const { return *m_chart; }
    void setClosable(bool closable);

    /// Hands the chart the traces as they are now.
    void refreshTraces();
    /// Grows with every sample that came: tells whether there is anything new to paint.
    std::uint64_t samplesSeen() const;
    /// The newest sample of all traces; zero where there is none.
    LineTime newest() const;

signals:
    void watchesDropped(const std::vector<dynascope::Watch> &watches);
    void removeRequested(const std::vector<dynascope::Watch> &watches);
    void closeRequested();
    void activated(); ///< clicked or focused: the present panel

protected:
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dragLeaveEvent(QDragLeaveEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void changeEvent(QEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void onRemoveRequested(const QList<int> &rows);
    void updateList();

    const Monitor &m_monitor;
    TraceModel *m_model;
    PlotChart *m_chart;
    TraceList *m_list;
    QToolButton *m_close;
    QBoxLayout *m_layout;
};

} // namespace dynascope
