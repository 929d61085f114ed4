// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"

#include <QMainWindow>

class QSplitter;
class QTreeView;

namespace dynascope {

class AlarmWatch;
class DeviceTreeModel;
class ElidedLabel;
class PlotArea;
class ReplayBar;
class Replayer;
class TablePanel;
struct UnitPreferences;

/// A window on a recording: devices, control table, plots and the glance at all of them as on a live bus, at the time at
/// which the replay stands. Nothing in it can write.
class ReplayWindow : public QMainWindow
{
    Q_OBJECT

public:
    /// All outlive this; `replayer` has opened its recording.
    ReplayWindow(Session &session, Monitor &monitor, Replayer &replayer, QWidget *parent = nullptr);
    ~ReplayWindow() override;

signals:
    void openRequested(const QString &path); ///< another recording
    void closed();

protected:
    void resizeEvent(QResizeEvent *event) override;
    void closeEvent(QCloseEvent *event) override;
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;

private:
    QWidget *makeDevices();
    void makeMenus();
    void connectParts();
    void onSelection();
    void onLoaded();
    void showWhole();
    void plotFirst();
    void setUnits(const UnitPreferences &units);
    void openDashboard();
    void showRecording();
    std::vector<Device *> selected() const;

    Session &m_session;
    Monitor &m_monitor;
    Replayer &m_replayer;
    AlarmWatch *m_alarms;
    ReplayBar *m_bar;
    QSplitter *m_outer, *m_inner;
    DeviceTreeModel *m_devices;
    QTreeView *m_tree;
    TablePanel *m_table;
    PlotArea *m_plots;
    ElidedLabel *m_said;
};

} // namespace dynascope
