// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/mainwindow.h"

#include "core/session/alarmwatch.h"
#include "core/session/commands.h"
#include "core/session/monitor.h"
#include "core/session/scanner.h"
#include "core/session/stopcontrol.h"
#include "ui/common/icons.h"
#include "ui/common/loweredge.h"
#include "ui/common/messagebar.h"
#include "ui/common/present.h"
#include "ui/common/stopkey.h"
#include "ui/connection/connectionbar.h"
#include "ui/connection/connector.h"
#include "ui/devices/deviceactions.h"
#include "ui/devices/devicepanel.h"
#include "ui/devices/leftmoves.h"
#include "ui/devices/nicknames.h"
#include "ui/health/healthpanel.h"
#include "ui/health/indirectnotice.h"
#include "ui/health/rateremedies.h"
#include "ui/health/wantedrates.h"
#include "ui/journal/undoactions.h"
#include "ui/plot/plotarea.h"
#include "ui/record/recordactions.h"
#include "ui/table/tablepanel.h"
#include "ui/window/firstread.h"
#include "ui/window/layoutmanager.h"
#include "ui/window/menus.h"
#include "ui/window/outcomes.h"
#include "ui/window/restartnotice.h"
#include "ui/window/statusview.h"
#include "ui/window/torqueguard.h"
#include "ui/window/unitmenu.h"
#include "ui/window/welcomepage.h"

#include <QApplication>
#include <QCloseEvent>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

const QString PlotsKey = QStringLiteral("window/plots");
const QString TableKey = QStringLiteral("window/table");

} // namespace

MainWindow::MainWindow(const Workbench &workbench, QWidget *parent)
    : QMainWindow(parent)
    , m_workbench(workbench)
    , m_connector(new Connector(workbench, this))
    , m_bar(new ConnectionBar(workbench, *m_connector, this))
    , m_stopBar(new MessageBar(this))
    , m_messages(new MessageBar(this))
    , m_pages(new QStackedWidget(this))
    , m_welcome(new WelcomePage(workbench.ports, this))
    , m_whole(new QSplitter(Qt::Vertical, this))
    , m_outer(new QSplitter(Qt::Horizontal, this))
    , m_inner(new QSplitter(Qt::Horizontal, this))
    , m_devices(new DevicePanel(workbench, this))
    , m_table(new TablePanel(workbench, this))
    , m_plots(new PlotArea(workbench, this))
    , m_record(new RecordActions(workbench, m_plots->events(), this))
    , m_health(new HealthPanel(this))
    , m_status(new StatusView(this))
    , m_guard(new TorqueGuard(workbench, this))
    , m_firstRead(new FirstRead(workbench, this))
    , m_alarms(new AlarmWatch(workbench.session, workbench.monitor, this))
{
    setObjectName(QStringLiteral("mainWindow"));
    setWindowTitle(tr("Dynascope"));
    setWindowIcon(applicationIcon());
    setMinimumSize(900, 600);
    setAcceptDrops(true);
    build();
    m_layout = new LayoutManager(*this, {*m_whole, *m_outer, *m_inner});
    std::vector<QAction *> editActions;
    if (m_workbench.undo) {
        auto *undo = new UndoActions(workbench, this);
        editActions = undo->actions();
        connect(undo, &UndoActions::failed, m_messages,
                [this](const QString &what) { m_messages->post(MessageKind::Error, what); });
    }
    std::vector<QAction *> saveActions = m_plots->saveActions();
    saveActions.push_back(nullptr);
    std::ranges::copy(m_record->actions(), std::back_inserter(saveActions));
    m_menus = new Menus(*this, {m_devices->actions().menuActions(), saveActions, editActions}, *m_layout);
    new Nicknames(workbench, this);

    auto *key = new StopKey(this);
    key->setButton(m_bar->stopButton());
    qApp->installEventFilter(key);
    connect(key, &StopKey::pressed, &m_workbench.stop, &StopControl::press);
    new Outcomes(workbench, *m_messages, *m_stopBar, [this](const Device &device) {
        const std::vector<Device *> selected = m_devices->selectedDevices();
        return std::ranges::find(selected, &device) != selected.end();
    });
    if (m_workbench.ramGuard) {
        new RestartNotice(workbench, *m_messages, [this](Device &device) {
            m_devices->selectDevice(&device);
            m_table->showSetHere();
        });
    }
    if (m_workbench.indirect)
        new IndirectNotice(*m_workbench.indirect, *m_messages, this);
    new WantedRates(workbench.session, workbench.monitor, this);
    auto *rates = new RateRemedies(workbench, this);
    connect(m_status, &StatusView::ratesRequested, rates, &RateRemedies::show);
    connect(rates, &RateRemedies::posted, m_messages, [this](MessageKind kind, const QString &text) { m_messages->post(kind, text); });
    connectConnection();
    connectDevices();
    connectPlots();
    setScheme(savedColorScheme());
    if (!Connector::lastPort().isEmpty())
        m_bar->setPort(Connector::lastPort(), Connector::lastBaudRate(Connector::lastPort()));
    restoreParts();
    onLines();
    m_pages->currentWidget()->setFocus();
}

MainWindow::~MainWindow() = default;

void MainWindow::build()
{
    m_stopBar->setObjectName(QStringLiteral("stopBar"));
    m_stopBar->setDismissable(false);
    m_devices->setMinimumWidth(216);
    m_table->setMinimumSize(360, 260);
    m_plots->setMinimumSize(280, 140);
    m_inner->addWidget(m_table);
    m_inner->addWidget(m_plots);
    m_outer->addWidget(m_devices);
    m_outer->addWidget(m_inner);
    m_pages->addWidget(m_welcome);
    m_whole->addWidget(m_outer);
    m_whole->addWidget(m_health);
    m_pages->addWidget(m_whole);

    auto *centre = new QWidget(this);
    auto *layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto *edge = new QFrame(centre);
    edge->setFrameShape(QFrame::HLine);
    edge->setFixedHeight(1);
    layout->addWidget(edge);
    layout->addWidget(m_pages, 1);
    setCentralWidget(centre);
    addToolBar(Qt::TopToolBarArea, m_bar);
    setContextMenuPolicy(Qt::NoContextMenu); // the one of a QMainWindow hides tool bars
    statusBar()->addWidget(m_status, 1);
    statusBar()->addPermanentWidget(m_record->badge());
    statusBar()->setSizeGripEnabled(false);
    // Both lie over the window: what moved under a pointer would have another servo hit. STOP's takes the place of the
    // figures, for it may stay long.
    (new LowerEdge(*m_stopBar, *statusBar()))->coverAll();
    (new LowerEdge(*m_messages, *centre))->standOn(*m_stopBar);
}

void MainWindow::connectConnection()
{
    const auto connectHere = [this](const QString &port) { connectTo(port, 0); };
    connect(m_connector, &Connector::posted, m_messages, qOverload<Message>(&MessageBar::post));
    connect(m_connector, &Connector::retracted, m_messages, &MessageBar::retract);
    connect(m_connector, &Connector::retractedTopic, m_messages, &MessageBar::retractTopic);
    connect(m_connector, &Connector::changed, this, &MainWindow::onLines);
    connect(m_menus, &Menus::reopeningToggled, m_connector, &Connector::setReopening);
    connect(m_bar, &ConnectionBar::currentLineChanged, this, &MainWindow::onLines);
    connect(&m_workbench.scanner, &Scanner::finished, this, &MainWindow::onLines);
    connect(&m_workbench.stop, &StopControl::changed, this, &MainWindow::onLines);
    connect(&m_workbench.scanner, &Scanner::progressChanged, this, &MainWindow::onLines);
    connect(m_welcome, &WelcomePage::choosePortRequested, m_bar, &ConnectionBar::showPorts);
    connect(m_welcome, &WelcomePage::connectRequested, this, connectHere);
    connect(m_menus, &Menus::choosePortRequested, m_bar, &ConnectionBar::choosePort);
    connect(m_menus, &Menus::toggleConnectionRequested, m_bar, &ConnectionBar::toggleConnection);
    connect(m_menus, &Menus::disconnectRequested, m_bar, &ConnectionBar::disconnectLine);
    connect(m_menus, &Menus::connectRequested, this, connectHere);
    connect(m_menus, &Menus::scanRequested, m_bar, &ConnectionBar::startScan);
    connect(m_menus, &Menus::scanOptionsRequested, m_bar, &ConnectionBar::showScanOptions);
    connect(m_menus, &Menus::resumeDemoRequested, this, &MainWindow::resumeDemoRequested);
    connect(m_menus, &Menus::stopRequested, &m_workbench.stop, &StopControl::press);
    connect(m_health, &HealthPanel::closeRequested, m_layout, [this] { m_layout->setHealthShown(false); });
    connect(m_menus, &Menus::commissionRequested, this, &MainWindow::openCommission);
    connect(m_menus, &Menus::libraryRequested, this, &MainWindow::openLibrary);
    connect(m_welcome, &WelcomePage::libraryRequested, this, &MainWindow::openLibrary);
    connect(m_menus, &Menus::dashboardRequested, this, &MainWindow::openDashboard);
    connect(m_menus, &Menus::profileRequested, this, &MainWindow::openProfile);
    connect(m_menus, &Menus::recordingRequested, this, &MainWindow::askForRecording);
    connect(m_menus, &Menus::focusRequested, this, &MainWindow::focusPane);
    connect(m_menus, &Menus::unitsChosen, this, &MainWindow::setUnits);
    connect(m_menus, &Menus::schemeRequested, this, [this](ColorScheme scheme) {
        saveColorScheme(scheme);
        emit schemeRequested(scheme);
    });
}

void MainWindow::connectDevices()
{
    connect(m_devices, &DevicePanel::selectionChanged, this, &MainWindow::onSelection);
    connect(m_devices, &DevicePanel::connectRequested, m_bar, &ConnectionBar::showPorts);
    connect(m_devices, &DevicePanel::scanRequested, m_bar, &ConnectionBar::startScan);
    connect(m_devices, &DevicePanel::disconnectRequested, m_connector, [this](LineSession *line) {
        m_connector->disconnectFrom(*line);
    });
    connect(&m_devices->actions(), &DeviceActions::posted, m_messages, qOverload<Message>(&MessageBar::post));
    auto *moves = new LeftMoves(m_workbench, this);
    connect(moves, &LeftMoves::posted, m_messages, qOverload<Message>(&MessageBar::post));
    connect(moves, &LeftMoves::retracted, m_messages, &MessageBar::retractTopic);
    connect(&m_devices->actions(), &DeviceActions::moveRequested, moves,
            [moves](LineSession *line, const std::vector<Device *> &devices) { moves->open(*line, devices); });
    connect(&m_devices->actions(), &DeviceActions::torqueEnabled, m_guard, &TorqueGuard::noteEnabled);
    connect(m_guard, &TorqueGuard::closeAgreed, this, &QWidget::close, Qt::QueuedConnection);
    connect(m_table, &TablePanel::notWritten, this,
            [this](const QString &text) { m_messages->post(MessageKind::Error, text); });
    connect(m_plots, &PlotArea::posted, m_messages, qOverload<Message>(&MessageBar::post));
    connect(m_record, &RecordActions::openRequested, this, &MainWindow::recordingRequested);
    connect(m_record, &RecordActions::posted, m_messages, qOverload<Message>(&MessageBar::post));
}

void MainWindow::setRefusedTables(const std::vector<RefusedTable> &refused)
{
    m_refused = refused;
    for (const RefusedTable &one : refused)
        m_messages->post(MessageKind::Warning, one.text);
}

void MainWindow::connectPlots()
{
    connect(m_table, &TablePanel::plotRequested, m_plots, &PlotArea::addTrace);
    connect(m_table, &TablePanel::unplotRequested, m_plots, &PlotArea::removeTrace);
    connect(m_plots, &PlotArea::tracesChanged, m_table, &TablePanel::refreshWatches);
    connect(m_table, &TablePanel::changeIdRequested, &m_devices->actions(), &DeviceActions::openChangeId);
    connect(m_table, &TablePanel::changeBaudRequested, &m_devices->actions(), &DeviceActions::openChangeBaud);
}

void MainWindow::connectTo(const QString &port, int baudRate)
{
    const QString name = port.isEmpty() ? Connector::lastPort() : port;
    if (name.isEmpty())
        return;
    const int baud = baudRate > 0 ? baudRate : Connector::lastBaudRate(name);
    m_bar->setPort(name, baud);
    m_connector->connectTo(name, baud);
}

void MainWindow::setScheme(ColorScheme scheme)
{
    m_menus->setScheme(scheme);
}

void MainWindow::say(MessageKind kind, const QString &text)
{
    m_messages->post(kind, text);
}

void MainWindow::onLines()
{
    LineSession *line = m_bar->currentLine();
    LineSession *shown = shownLine();
    const bool open = line && line->state() == BusThread::State::Open;
    m_status->setLine(shown);
    m_health->setLine(shown);
    const bool broken =
        line && (line->state() == BusThread::State::Lost || line->state() == BusThread::State::Closed);
    m_menus->setConnection(!line    ? Menus::Connection::None
                           : broken ? Menus::Connection::Broken
                                    : Menus::Connection::Present,
                           open && !m_workbench.scanner.isRunning(),
                           open && line->name() == QStringLiteral("sim") && !m_workbench.stop.isActive());
    // A line that is only being opened for the first time changes nothing yet: it may not come to be.
    const auto &lines = m_workbench.session.lines();
    const bool any = std::ranges::any_of(lines, [](const auto &each) {
        return each->state() == BusThread::State::Open || !each->devices().empty();
    });
    if (any != (m_pages->currentWidget() == m_whole)) {
        // What had the focus hides; it must not fall to the next in the chain, perhaps STOP.
        setFocus();
        m_pages->setCurrentWidget(any ? static_cast<QWidget *>(m_whole) : m_welcome);
        if (any)
            focusPane(0);
        else
            m_welcome->setFocus();
    }
    setWindowTitle(shown ? tr("%1 – Dynascope").arg(shown->name()) : tr("Dynascope"));
}

/// That of the port which is chosen, else the selected device's, else the only one.
LineSession *MainWindow::shownLine() const
{
    if (LineSession *line = m_bar->currentLine())
        return line;
    if (LineSession *line = m_devices->selectedLine())
        return line;
    const auto &lines = m_workbench.session.lines();
    return lines.size() == 1 ? lines.front().get() : nullptr;
}

void MainWindow::onSelection()
{
    const std::vector<Device *> devices = m_devices->selectedDevices();
    if (LineSession *line = m_devices->selectedLine())
        m_bar->showLine(*line);
    m_table->setDevices(devices);
    m_table->setSelected(devices.size());
    m_workbench.monitor.select(devices);
    m_firstRead->show(devices);
}

void MainWindow::focusPane(int pane)
{
    QWidget *target = std::array<QWidget *, 3>{m_devices, m_table, m_plots}[static_cast<std::size_t>(pane)];
    // The first thing in it that takes keys; a pane itself takes none.
    for (QWidget *child : target->findChildren<QWidget *>()) {
        if (child->isVisible() && child->isEnabled() && child->inherits("QAbstractItemView")
            && (child->focusPolicy() & Qt::TabFocus)) {
            child->setFocus(Qt::ShortcutFocusReason);
            return;
        }
    }
    if (QWidget *next = target->nextInFocusChain())
        next->setFocus(Qt::ShortcutFocusReason);
}

void MainWindow::setUnits(const UnitPreferences &units)
{
    m_table->setUnits(units);
    m_plots->setUnits(units);
}

void MainWindow::restoreParts()
{
    m_layout->restore();
    setUnits(savedUnits()); // before the plots' scales
    const QSettings settings;
    m_plots->restoreState(settings.value(PlotsKey).toByteArray());
    m_table->restoreState(settings.value(TableKey).toByteArray());
}

void MainWindow::saveParts() const
{
    m_layout->save();
    QSettings settings;
    settings.setValue(PlotsKey, m_plots->saveState());
    settings.setValue(TableKey, m_table->saveState());
}

void MainWindow::closeEvent(QCloseEvent *event)
{
    if (!m_guard->mayClose()) {
        event->ignore();
        return;
    }
    m_record->finish();
    saveParts();
    closeDialogs(*this);
    QMainWindow::closeEvent(event);
}

} // namespace dynascope
