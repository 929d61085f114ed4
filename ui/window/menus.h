// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/theme.h"
#include "ui/window/layoutmanager.h"

#include <QObject>

class QAction;
class QMainWindow;
class QMenu;

namespace dynascope {

struct UnitPreferences;

/// The menu bar. Knows what there is to ask for, not how it is done.
class Menus : public QObject
{
    Q_OBJECT

public:
    /// What others own and the menus only offer; nullptr stands for a separator.
    struct Offered {
        std::vector<QAction *> device;
        std::vector<QAction *> save;
        std::vector<QAction *> edit = {};
    };

    Menus(QMainWindow &window, const Offered &offered, LayoutManager &layout);

    enum class Connection { None, Present, Broken };
    void setConnection(Connection connection, bool canScan, bool simulated);
    void setScheme(ColorScheme scheme); ///< which one is ticked

signals:
    void choosePortRequested();
    void toggleConnectionRequested();
    void disconnectRequested(); ///< of a broken line, that the toggle opens again
    void connectRequested(const QString &port);
    void reopeningToggled(bool byItself);
    void scanRequested();
    void scanOptionsRequested();
    void schemeRequested(dynascope::ColorScheme scheme);
    void unitsChosen(const dynascope::UnitPreferences &units);
    void focusRequested(int pane); ///< 0 devices, 1 table, 2 plots
    void libraryRequested();
    void dashboardRequested();
    void profileRequested();
    void recordingRequested(); ///< to be opened
    void commissionRequested();
    void resumeDemoRequested();
    void stopRequested();

private:
    QAction *add(
        QMenu *menu, const QString &name, const QString &text, const QString &shortcut, const QString &iconName = {});
    void makeFileMenu(const std::vector<QAction *> &saveActions);
    void makeEditMenu(const std::vector<QAction *> &actions);
    void makeViewMenu(LayoutManager &layout);
    void addHealth(QMenu *menu, LayoutManager &layout);
    void makeDeviceMenu(const std::vector<QAction *> &actions);
    void makeDemoMenu();
    void makeHelpMenu();
    void fillRecent(QMenu *menu);

    QMainWindow &m_window;
    QAction *m_connect = nullptr;
    QAction *m_disconnect = nullptr;
    QAction *m_scan = nullptr;
    QAction *m_scanOptions = nullptr;
    QAction *m_commission = nullptr;
    QAction *m_resumeDemo = nullptr;
    std::vector<QAction *> m_schemes;
};

} // namespace dynascope
