// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "core/table/usertables.h"
#include "ui/common/messagebar.h"
#include "ui/common/theme.h"
#include "ui/common/workbench.h"

#include <QMainWindow>

class QSplitter;
class QStackedWidget;

namespace dynascope {

class AlarmWatch;
class ConnectionBar;
class Connector;
class DevicePanel;
class FirstRead;
class HealthPanel;
class LayoutManager;
class Menus;
class PlotArea;
class RecordActions;
class StatusView;
class TablePanel;
class TorqueGuard;
class WelcomePage;
struct UnitPreferences;
struct Watch;

/// The window: devices left, control table centre, plots right or below, Bus health under them where it is wanted;
/// connection bar, STOP, message bar, status bar.
/// It puts its parts together and decides nothing about devices.
class MainWindow : public QMainWindow
{
    Q_OBJECT

public:
    explicit MainWindow(const Workbench &workbench, QWidget *parent = nullptr);
    ~MainWindow() override;

    /// Opens a line and scans it: the port of the command line or, where `port` is empty, the one from last time;
    /// without either the welcome stays. `baudRate` 0: the one from last time.
    void connectTo(const QString &port, int baudRate);

    /// Table files that weren't read: said now, and listed where tables are looked up.
    void setRefusedTables(const std::vector<RefusedTable> &refused);

    void setScheme(ColorScheme scheme); ///< which one the menu ticks; applied by who asked for it
    void say(MessageKind kind, const QString &text); ///< in the message bar

signals:
    void schemeRequested(dynascope::ColorScheme scheme);
    void resumeDemoRequested();
    void recordingRequested(const QString &path); ///< to be opened

protected:
    void closeEvent(QCloseEvent *event) override;
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dropEvent(QDropEvent *event) override;

private:
    void build();
    void connectDevices();
    void connectConnection();
    void connectPlots();
    void setUnits(const UnitPreferences &units);
    void onSelection();
    void onLines();
    void openLibrary();
    void openDashboard();
    void openProfile();
    void openCommission();
    void askForRecording();
    LineSession *shownLine() const; ///< what status bar, Bus health and title tell about; nullptr: none is open
    void focusPane(int pane);
    void restoreParts();
    void saveParts() const;

    Workbench m_workbench;
    std::vector<RefusedTable> m_refused;
    Connector *m_connector;
    ConnectionBar *m_bar;
    MessageBar *m_stopBar;
    MessageBar *m_messages;
    QStackedWidget *m_pages;
    WelcomePage *m_welcome;
    QSplitter *m_whole;
    QSplitter *m_outer;
    QSplitter *m_inner;
    DevicePanel *m_devices;
    TablePanel *m_table;
    PlotArea *m_plots;
    RecordActions *m_record;
    HealthPanel *m_health;
    StatusView *m_status;
    LayoutManager *m_layout;
    Menus *m_menus;
    TorqueGuard *m_guard;
    FirstRead *m_firstRead;
    AlarmWatch *m_alarms;
};

} // namespace dynascope
