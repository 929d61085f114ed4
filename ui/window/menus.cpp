// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/menus.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/connection/connector.h"
#include "ui/window/helpdialogs.h"
#include "ui/window/unitmenu.h"

#include <QAction>
#include <QActionGroup>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>

namespace dynascope {

Menus::Menus(QMainWindow &window, const Offered &offered, LayoutManager &layout)
    : QObject(&window)
    , m_window(window)
{
    makeFileMenu(offered.save);
    makeEditMenu(offered.edit);
    makeViewMenu(layout);
    makeDeviceMenu(offered.device);
    makeDemoMenu();
    makeHelpMenu();
    setConnection(Connection::None, false, false);
}

QAction *Menus::add(
    QMenu *menu, const QString &name, const QString &text, const QString &shortcut, const QString &iconName)
{
    QAction *action = menu->addAction(text);
    action->setObjectName(name);
    action->setShortcut(QKeySequence(shortcut));
    action->setAutoRepeat(false); // a key held down is one order
    if (!iconName.isEmpty())
        action->setIcon(icon(iconName));
    return action;
}

void Menus::makeFileMenu(const std::vector<QAction *> &saveActions)
{
    QMenu *menu = m_window.menuBar()->addMenu(tr("&File"));
    QAction *choose = add(menu, QStringLiteral("choosePortAction"), tr("Choose &port…"), QStringLiteral("Ctrl+L"),
                          QStringLiteral("plug"));
    connect(choose, &QAction::triggered, this, &Menus::choosePortRequested);
    m_connect = add(menu, QStringLiteral("toggleConnectionAction"), tr("&Connect"), QStringLiteral("Ctrl+Return"),
                    QStringLiteral("connect"));
    connect(m_connect, &QAction::triggered, this, &Menus::toggleConnectionRequested);
    m_disconnect =
        add(menu, QStringLiteral("disconnectAction"), tr("&Disconnect"), {}, QStringLiteral("disconnect"));
    connect(m_disconnect, &QAction::triggered, this, &Menus::disconnectRequested);
    QMenu *recent = menu->addMenu(tr("&Recent ports"));
    connect(recent, &QMenu::aboutToShow, this, [this, recent] { fillRecent(recent); });
    QAction *reopen = add(menu, QStringLiteral("reopenAction"), tr("Reconnect &by itself when plugged in again"), {});
    reopen->setCheckable(true);
    reopen->setChecked(Connector::isReopening());
    connect(reopen, &QAction::toggled, this, &Menus::reopeningToggled);
    menu->addSeparator();
    m_scan = add(menu, QStringLiteral("scanAction"), tr("&Scan"), QStringLiteral("Ctrl+R"), QStringLiteral("scan"));
    connect(m_scan, &QAction::triggered, this, &Menus::scanRequested);
    m_scanOptions =
        add(menu, QStringLiteral("scanOptionsAction"), tr("Scan &options…"), QStringLiteral("Ctrl+Shift+R"));
    connect(m_scanOptions, &QAction::triggered, this, &Menus::scanOptionsRequested);
    m_commission = add(menu, QStringLiteral("commissionAction"), tr("Commission &new servos…"),
                       QStringLiteral("Ctrl+Shift+N"), QStringLiteral("servo"));
    m_commission->setToolTip(tr("New servos, plugged in one after the other, get their IDs, baud rate and settings"));
    connect(m_commission, &QAction::triggered, this, &Menus::commissionRequested);
    menu->addSeparator();
    QAction *profile = add(menu, QStringLiteral("profileAction"), tr("Robot pro&file…"), QStringLiteral("Ctrl+Shift+P"),
                           QStringLiteral("differs"));
    connect(profile, &QAction::triggered, this, &Menus::profileRequested);
    QAction *recording = add(menu, QStringLiteral("openRecordingAction"), tr("&Open recording…"), QStringLiteral("Ctrl+O"),
                             QStringLiteral("film"));
    recording->setToolTip(tr("What was recorded, in a window of its own, at any speed"));
    connect(recording, &QAction::triggered, this, &Menus::recordingRequested);
    menu->addSeparator();
    for (QAction *action : saveActions) {
        if (action)
            menu->addAction(action);
        else
            menu->addSeparator();
    }
    menu->addSeparator();
    QAction *quit = add(menu, QStringLiteral("quitAction"), tr("&Quit"), QStringLiteral("Ctrl+Q"));
    quit->setMenuRole(QAction::QuitRole);
    connect(quit, &QAction::triggered, &m_window, &QWidget::close);
}

void Menus::makeEditMenu(const std::vector<QAction *> &actions)
{
    if (actions.empty())
        return;
    QMenu *menu = m_window.menuBar()->addMenu(tr("&Edit"));
    for (QAction *action : actions) {
        if (action)
            menu->addAction(action);
        else
            menu->addSeparator();
    }
}

void Menus::fillRecent(QMenu *menu)
{
    menu->clear();
    for (const QString &port : Connector::recentPorts())
        connect(
            menu->addAction(plainLabel(portText(port))), &QAction::triggered, this, [this, port] { emit connectRequested(port); });
    if (menu->isEmpty())
        menu->addAction(tr("None yet"))->setEnabled(false);
}

void Menus::makeViewMenu(LayoutManager &layout)
{
    QMenu *menu = m_window.menuBar()->addMenu(tr("&View"));
    QMenu *scheme = menu->addMenu(icon(QStringLiteral("sun")), tr("&Colours"));
    auto *schemes = new QActionGroup(this);
    const auto addScheme = [&](ColorScheme value, const QString &name, const QString &text) {
        QAction *action = add(scheme, name, text, {});
        action->setCheckable(true);
        schemes->addAction(action);
        m_schemes.push_back(action);
        connect(action, &QAction::triggered, this, [this, value] { emit schemeRequested(value); });
    };
    addScheme(ColorScheme::System, QStringLiteral("schemeSystemAction"), tr("As the &system"));
    addScheme(ColorScheme::Light, QStringLiteral("schemeLightAction"), tr("&Light"));
    addScheme(ColorScheme::Dark, QStringLiteral("schemeDarkAction"), tr("&Dark"));
    connect(new UnitMenu(*menu, this), &UnitMenu::chosen, this, &Menus::unitsChosen);
    menu->addSeparator();

    auto *places = new QActionGroup(this);
    QAction *right = add(menu, QStringLiteral("plotsRightAction"), tr("Plots at the &right"),
        QStringLiteral("Ctrl+Alt+Right"), QStringLiteral("layout-right"));
    QAction *below = add(menu, QStringLiteral("plotsBelowAction"), tr("Plots &below"), QStringLiteral("Ctrl+Alt+Down"),
                         QStringLiteral("layout-below"));
    for (QAction *action : {right, below}) {
        action->setCheckable(true);
        places->addAction(action);
    }
    connect(right, &QAction::triggered, &layout, [&layout] { layout.setPlotPlace(PlotPlace::Right); });
    connect(below, &QAction::triggered, &layout, [&layout] { layout.setPlotPlace(PlotPlace::Below); });
    const auto tick = [&layout, right, below] {
        (layout.plotPlace() == PlotPlace::Right ? right : below)->setChecked(true);
    };
    connect(&layout, &LayoutManager::plotPlaceChanged, this, tick);
    tick();
    menu->addSeparator();
    QAction *dashboard = add(menu, QStringLiteral("dashboardAction"), tr("At a &glance…"), QStringLiteral("Ctrl+G"),
                             QStringLiteral("gauge"));
    dashboard->setToolTip(tr("All devices in one table, the worst first, and their alarms"));
    connect(dashboard, &QAction::triggered, this, &Menus::dashboardRequested);
    addHealth(menu, layout);
    QAction *library = add(menu, QStringLiteral("libraryAction"), tr("&Look up control tables…"),
                           QStringLiteral("Ctrl+Shift+L"), QStringLiteral("search"));
    library->setToolTip(tr("The registers of any model, without the device; search over all models"));
    connect(library, &QAction::triggered, this, &Menus::libraryRequested);
    QAction *reset = add(menu, QStringLiteral("resetLayoutAction"), tr("R&eset the layout"), {});
    connect(reset, &QAction::triggered, &layout, &LayoutManager::reset);
    menu->addSeparator();

    const QStringList panes{tr("Go to &devices"), tr("Go to the control &table"), tr("Go to the &plots")};
    for (int pane = 0; pane < panes.size(); ++pane) {
        QAction *action = add(menu, QStringLiteral("focusPane%1Action").arg(pane), panes[pane],
                              QStringLiteral("Ctrl+%1").arg(pane + 1));
        connect(action, &QAction::triggered, this, [this, pane] { emit focusRequested(pane); });
    }
}

void Menus::addHealth(QMenu *menu, LayoutManager &layout)
{
    QAction *health = add(
        menu, QStringLiteral("busHealthAction"), tr("Bus &health"), QStringLiteral("Ctrl+H"), QStringLiteral("health"));
    health->setCheckable(true);
    health->setToolTip(tr("How well each device answers, and what goes wrong on the line"));
    connect(health, &QAction::toggled, &layout, &LayoutManager::setHealthShown);
    const auto tick = [&layout, health] { health->setChecked(layout.isHealthShown()); };
    connect(&layout, &LayoutManager::healthShownChanged, this, tick);
    tick();
}

void Menus::makeDeviceMenu(const std::vector<QAction *> &actions)
{
    QMenu *menu = m_window.menuBar()->addMenu(tr("&Device"));
    menu->setToolTipsVisible(true);
    // Esc is caught by a filter that works in editors and dialogs too; a shortcut here would only be in its way.
    QAction *stop =
        add(menu, QStringLiteral("stopAction"), tr("STOP, torque off everywhere\tEsc"), {}, QStringLiteral("stop"));
    stop->setToolTip(tr("Turns the torque of every device off at once (Esc)"));
    connect(stop, &QAction::triggered, this, &Menus::stopRequested);
    menu->addSeparator();
    for (QAction *action : actions) {
        if (action)
            menu->addAction(action);
        else
            menu->addSeparator();
    }
}

void Menus::makeDemoMenu()
{
    QMenu *menu = m_window.menuBar()->addMenu(tr("De&mo"));
    m_resumeDemo = add(menu, QStringLiteral("resumeDemoAction"), tr("&Resume demo"), QStringLiteral("Ctrl+Shift+D"),
                       QStringLiteral("play"));
    m_resumeDemo->setToolTip(tr("The simulated arm moves by its script again"));
    connect(m_resumeDemo, &QAction::triggered, this, &Menus::resumeDemoRequested);
}

void Menus::makeHelpMenu()
{
    QMenu *menu = m_window.menuBar()->addMenu(tr("&Help"));
    QAction *keys = add(menu, QStringLiteral("shortcutsAction"), tr("&Keyboard shortcuts"), QStringLiteral("F1"),
                        QStringLiteral("keyboard"));
    connect(keys, &QAction::triggered, this, [this] { showShortcuts(m_window); });
    QAction *about = add(menu, QStringLiteral("aboutAction"), tr("&About Dynascope"), {}, QStringLiteral("info"));
    about->setMenuRole(QAction::AboutRole);
    connect(about, &QAction::triggered, this, [this] { showAbout(m_window); });
}

void Menus::setConnection(Connection connection, bool canScan, bool simulated)
{
    const bool present = connection == Connection::Present;
    const bool broken = connection == Connection::Broken;
    m_connect->setText(present ? tr("Dis&connect") : broken ? tr("Re&connect") : tr("&Connect"));
    m_disconnect->setVisible(broken);
    m_connect->setIcon(icon(present ? QStringLiteral("disconnect") : QStringLiteral("connect")));
    m_scan->setEnabled(canScan);
    m_scanOptions->setEnabled(canScan);
    m_commission->setEnabled(canScan);
    m_resumeDemo->setEnabled(simulated);
}

void Menus::setScheme(ColorScheme scheme)
{
    m_schemes[static_cast<std::size_t>(scheme)]->setChecked(true);
}

} // namespace dynascope
