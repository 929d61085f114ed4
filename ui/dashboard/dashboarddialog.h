// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/dashboard/faultsaver.h"

#include <QDialog>
#include <QElapsedTimer>

class QLabel;
class QSplitter;
class QStackedWidget;
class QToolButton;
class QTreeView;

namespace dynascope {

class AlarmModel;
class AlarmWatch;
class DashboardModel;
class Device;
class ElidedLabel;
class Monitor;
class Session;
struct UnitPreferences;

/// All devices at a glance, the worst first, and under them the alarms, each with what was kept of the time around it.
/// While it is shown, position and load of all devices are polled, too.
class DashboardDialog : public QDialog
{
    Q_OBJECT

public:
    /// The first three outlive this.
    DashboardDialog(Session &session, Monitor &monitor, AlarmWatch &watch, QWidget *window);
    ~DashboardDialog() override;

    void setUnits(const UnitPreferences &units);

signals:
    void deviceChosen(dynascope::Device *device); ///< by a person, in either list

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    QWidget *makeHead();
    void makeDevices();
    QWidget *makeAlarms();
    void refresh();
    void refreshAlarms();
    void choose(DeviceKey key);
    const Alarm *selectedAlarm() const;
    void save();

    Session &m_session;
    Monitor &m_monitor;
    AlarmWatch &m_watch;
    DashboardModel *m_model;
    AlarmModel *m_alarms;
    FaultSaver *m_saver;
    QSplitter *m_splitter;
    ElidedLabel *m_summary;
    ElidedLabel *m_limits;
    QStackedWidget *m_stack;
    QLabel *m_empty;
    QTreeView *m_devices;
    QStackedWidget *m_alarmStack;
    QTreeView *m_alarmView;
    ElidedLabel *m_said;
    QToolButton *m_save;
    QToolButton *m_forget;
    QElapsedTimer m_shown; ///< since the figures were made
};

} // namespace dynascope
