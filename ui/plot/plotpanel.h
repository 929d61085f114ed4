// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/monitor.h"
#include "ui/plot/timewindow.h"

#include <QFrame>

class QBoxLayout;
class QMenu;
class QToolButton;

namespace dynascope {

class EventLog;
struct LabelColumns;
class MeasureModel;
class MeasureTable;
class PlotChart;
struct PlotCursors;
class TraceColors;
class TraceList;
class TraceModel;

/// A chart with the list of its traces beside it, or below where it is narrow. A drop target for fields.
class PlotPanel : public QFrame
{
    Q_OBJECT

public:
    /// What all panels have in common. Outlives them.
    struct Common {
        Session &session;
        const Monitor &monitor;
        const TimeWindow &window;
        TraceColors &colors;
        const EventLog &events;
    };
    explicit PlotPanel(const Common &common, QWidget *parent = nullptr);
    ~PlotPanel() override;

    TraceModel &model() const { return *m_model; }
    PlotChart &chart() const { return *m_chart; }
    const MeasureModel *figures() const; ///< between the cursors, while these are on
    void setClosable(bool closable);
    void setLive(bool live); ///< else it offers the way back

    /// A time axis of its own, that of the others, or theirs.
    bool hasOwnTime() const { return m_hasOwnTime; }
    void setOwnTime(bool own);
    TimeWindow &ownTime() { return m_ownTime; }

    void setLabelRoom(LabelColumns room); ///< see PlotChart
    void setCursors(const PlotCursors &cursors);
    /// See MeasureModel. Nothing to do without cursors.
    void measure(const PlotCursors &cursors, std::size_t &budget);
    void setNewest(LineTime newest);
    void showFigures();

    /// Hands the chart the traces as they are now.
    void refreshTraces();
    /// Grows with every sample that came: tells whether there is anything new to paint.
    std::uint64_t samplesSeen() const;
    /// The newest sample of all traces; zero where there is none.
    LineTime newest() const;

signals:
    void watchesDropped(const std::vector<dynascope::Watch> &watches);
    void removeRequested(const std::vector<dynascope::TraceKey> &keys);
    void deriveRequested(const dynascope::TraceKey &key);
    void closeRequested();
    void liveRequested();
    void ownTimeChanged();
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
    void makeButtons();
    void placeButtons();
    void shareHeight();
    void fillMenu();

    const Monitor &m_monitor;
    const EventLog &m_events;
    const TimeWindow &m_sharedTime;
    TimeWindow m_ownTime;
    QRect m_placedIn; ///< the plot's area when its buttons were placed
    bool m_hasOwnTime = false;
    bool m_isClosable = false;
    bool m_isMeasured = false; ///< all of what stands between the cursors now
    TraceModel *m_model;
    PlotChart *m_chart;
    TraceList *m_list;
    MeasureModel *m_figures;
    MeasureTable *m_table;
    QToolButton *m_more;
    QToolButton *m_toLive;
    QMenu *m_menu;
    QBoxLayout *m_layout;
};

} // namespace dynascope
