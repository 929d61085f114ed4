// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/replay/replaywindow.h"

#include "core/replay/replayer.h"
#include "core/session/alarmwatch.h"
#include "core/session/linesession.h"
#include "ui/common/elidedlabel.h"
#include "ui/common/icons.h"
#include "ui/common/present.h"
#include "ui/dashboard/dashboarddialog.h"
#include "ui/devices/devicetree.h"
#include "ui/devices/devicetreemodel.h"
#include "ui/plot/plotarea.h"
#include "ui/replay/openrecording.h"
#include "ui/replay/replaybar.h"
#include "ui/replay/replaytexts.h"
#include "ui/table/tablepanel.h"
#include "ui/window/unitmenu.h"

#include <QCloseEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

const QString GeometryKey = QStringLiteral("replay/geometry");
const QString OuterKey = QStringLiteral("replay/outer");
const QString InnerKey = QStringLiteral("replay/inner");

constexpr int NarrowWidth = 1180; ///< pixels
constexpr int SaidFor = 8000; ///< ms
constexpr std::size_t PlottedFirst = 8; ///< traces

TableActions readOnly(Monitor &monitor)
{
    TableActions actions;
    actions.isWatched = [&monitor](const Watch &watch) { return monitor.isWatched(watch); };
    return actions;
}

} // namespace

ReplayWindow::ReplayWindow(Session &session, Monitor &monitor, Replayer &replayer, QWidget *parent)
    : QMainWindow(parent)
    , m_session(session)
    , m_monitor(monitor)
    , m_replayer(replayer)
    , m_alarms(new AlarmWatch(session, monitor, this))
    , m_bar(new ReplayBar(replayer, this))
    , m_outer(new QSplitter(Qt::Horizontal, this))
    , m_inner(new QSplitter(Qt::Horizontal, this))
    , m_devices(new DeviceTreeModel(session, this))
    , m_tree(new QTreeView(this))
    , m_table(new TablePanel(readOnly(monitor), {}, this))
    , m_plots(new PlotArea(session, monitor, this))
    , m_said(new ElidedLabel(this))
{
    setObjectName(QStringLiteral("replayWindow"));
    setWindowTitle(tr("%1 – Dynascope").arg(QFileInfo(replayer.path()).fileName()));
    setWindowFilePath(replayer.path());
    setWindowIcon(applicationIcon());
    setMinimumSize(900, 600);
    setAcceptDrops(true);
    setContextMenuPolicy(Qt::NoContextMenu);
    m_inner->addWidget(m_table);
    m_inner->addWidget(m_plots);
    m_outer->addWidget(makeDevices());
    m_outer->addWidget(m_inner);
    for (QSplitter *splitter : {m_outer, m_inner}) {
        splitter->setChildrenCollapsible(false);
        splitter->setHandleWidth(1);
    }
    m_table->setMinimumSize(360, 260);
    m_plots->setMinimumSize(280, 140);
    auto *centre = new QWidget(this);
    auto *layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_bar);
    auto *edge = new QFrame(centre);
    edge->setFrameShape(QFrame::HLine);
    edge->setFixedHeight(1);
    layout->addWidget(edge);
    layout->addWidget(m_outer, 1);
    setCentralWidget(centre);
    m_said->setObjectName(QStringLiteral("recordingText"));
    m_said->setContentsMargins(10, 0, 0, 0);
    statusBar()->addWidget(m_said, 1);
    statusBar()->setSizeGripEnabled(false);
    makeMenus();
    connectParts();
    setUnits(savedUnits());
    resize(1280, 800);
    m_outer->setSizes({240, 1040});
    m_inner->setSizes({520, 520});
    const QSettings settings;
    restoreGeometry(settings.value(GeometryKey).toByteArray());
    m_outer->restoreState(settings.value(OuterKey).toByteArray());
    const Qt::Orientation fitting = m_inner->orientation();
    if (m_inner->restoreState(settings.value(InnerKey).toByteArray()) && m_inner->orientation() != fitting)
        m_inner->setOrientation(fitting); // it was of another width
    if (const std::vector<Device *> devices = session.devices(); !devices.empty())
        m_tree->setCurrentIndex(m_devices->indexOf(devices.front()));
    showRecording();
    m_tree->setFocus();
    showWhole();
    if (replayer.isLoaded())
        onLoaded();
}

ReplayWindow::~ReplayWindow() = default;

QWidget *ReplayWindow::makeDevices()
{
    auto *panel = new QWidget(this);
    auto *layout = new QVBoxLayout(panel);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto *title = new QLabel(tr("Devices"), panel);
    QFont bold = title->font();
    bold.setWeight(QFont::DemiBold);
    title->setFont(bold);
    title->setContentsMargins(12, 4, 4, 4);
    title->setFixedHeight(37);
    layout->addWidget(title);
    setUpDeviceTree(*m_tree, *m_devices);
    layout->addWidget(m_tree, 1);
    panel->setMinimumWidth(216);
    return panel;
}

void ReplayWindow::makeMenus()
{
    QMenu *file = menuBar()->addMenu(tr("&File"));
    QAction *open = file->addAction(icon(QStringLiteral("film")), tr("Open &recording…"));
    open->setShortcut(QKeySequence::Open);
    connect(open, &QAction::triggered, this,
            [this] { askForRecording(this, [this](const QString &path) { emit openRequested(path); }); });
    file->addSeparator();
    for (QAction *action : m_plots->saveActions())
        action ? file->addAction(action) : void(file->addSeparator());
    file->addSeparator();
    QAction *close = file->addAction(icon(QStringLiteral("close")), tr("&Close"));
    close->setShortcut(QKeySequence::Close);
    connect(close, &QAction::triggered, this, &QWidget::close);

    QMenu *replay = menuBar()->addMenu(tr("&Replay"));
    m_bar->fill(*replay);
    replay->addSeparator();
    QAction *whole = replay->addAction(icon(QStringLiteral("fit")), tr("Plot the &whole recording"));
    whole->setShortcut(QKeySequence(QStringLiteral("Ctrl+0")));
    connect(whole, &QAction::triggered, this, &ReplayWindow::showWhole);

    QMenu *view = menuBar()->addMenu(tr("&View"));
    connect(new UnitMenu(*view, this), &UnitMenu::chosen, this, &ReplayWindow::setUnits);
    view->addSeparator();
    QAction *glance = view->addAction(icon(QStringLiteral("gauge")), tr("At a &glance…"));
    glance->setObjectName(QStringLiteral("dashboardAction"));
    glance->setShortcut(QKeySequence(QStringLiteral("Ctrl+G")));
    connect(glance, &QAction::triggered, this, &ReplayWindow::openDashboard);
}

void ReplayWindow::connectParts()
{
    connect(m_tree->selectionModel(), &QItemSelectionModel::selectionChanged, this, &ReplayWindow::onSelection);
    connect(m_table, &TablePanel::plotRequested, m_plots, &PlotArea::addTrace);
    connect(m_table, &TablePanel::unplotRequested, m_plots, &PlotArea::removeTrace);
    connect(m_plots, &PlotArea::tracesChanged, m_table, &TablePanel::refreshWatches);
    connect(m_plots, &PlotArea::posted, this, [this](const Message &message) { statusBar()->showMessage(message.text, SaidFor); });
    connect(&m_replayer, &Replayer::moved, m_plots, &PlotArea::follow);
    connect(&m_replayer, &Replayer::jumped, m_alarms, &AlarmWatch::startAnew);
    connect(&m_replayer, &Replayer::loadProgressed, this, &ReplayWindow::showRecording);
    connect(&m_replayer, &Replayer::loaded, this, &ReplayWindow::onLoaded);
}

std::vector<Device *> ReplayWindow::selected() const
{
    std::vector<Device *> devices;
    for (Device *device : m_session.devices()) { // in the order of the tree
        if (m_tree->selectionModel()->isSelected(m_devices->indexOf(device)))
            devices.push_back(device);
    }
    return devices;
}

void ReplayWindow::onSelection()
{
    const std::vector<Device *> devices = selected();
    m_table->setDevices(devices);
    m_table->setSelected(devices.size());
}

void ReplayWindow::onLoaded()
{
    m_plots->events().showRecorded(m_replayer.events());
    if (m_plots->traces().empty())
        plotFirst();
    showWhole();
    showRecording();
}

void ReplayWindow::showWhole()
{
    const ReplayClock &clock = m_replayer.clock();
    m_plots->setRecording(clock.begin(), clock.end());
    m_plots->showTimes(clock.begin(), clock.end());
}

/// The positions, or else what there is.
void ReplayWindow::plotFirst()
{
    std::vector<Watch> positions, all;
    for (const ReplayDevice &device : m_replayer.devices().devices) {
        for (const ReplayField &field : device.fields) {
            const Watch watch{device.key, field.field};
            if (!m_monitor.history(watch))
                continue;
            all.push_back(watch);
            if (field.recorded.name == u"Present Position")
                positions.push_back(watch);
        }
    }
    std::vector<Watch> &first = positions.empty() ? all : positions;
    first.resize(std::min(first.size(), PlottedFirst));
    for (const Watch &watch : first)
        m_plots->addTrace(watch);
}

void ReplayWindow::setUnits(const UnitPreferences &units)
{
    m_table->setUnits(units);
    m_plots->setUnits(units);
    if (auto *dashboard = findChild<DashboardDialog *>())
        dashboard->setUnits(units);
}

void ReplayWindow::openDashboard()
{
    if (raiseOpen(*this, QStringLiteral("dashboardDialog")))
        return;
    auto *dashboard = new DashboardDialog(m_session, m_monitor, *m_alarms, this);
    dashboard->setUnits(savedUnits());
    connect(dashboard, &DashboardDialog::deviceChosen, this,
            [this](Device *device) { m_tree->setCurrentIndex(m_devices->indexOf(device)); });
    present(*dashboard);
}

void ReplayWindow::showRecording()
{
    m_said->setText(recordingText(m_replayer));
}

/// Where table and plots have no room beside each other, one stands above the other.
void ReplayWindow::resizeEvent(QResizeEvent *event)
{
    QMainWindow::resizeEvent(event);
    const Qt::Orientation fitting = width() < NarrowWidth ? Qt::Vertical : Qt::Horizontal;
    if (m_inner->orientation() == fitting)
        return;
    m_inner->setOrientation(fitting);
    m_inner->setSizes({1, 1}); // halves
}

void ReplayWindow::closeEvent(QCloseEvent *event)
{
    QSettings settings;
    settings.setValue(GeometryKey, saveGeometry());
    settings.setValue(OuterKey, m_outer->saveState());
    settings.setValue(InnerKey, m_inner->saveState());
    m_replayer.pause();
    closeDialogs(*this);
    QMainWindow::closeEvent(event);
    emit closed();
}

void ReplayWindow::dragEnterEvent(QDragEnterEvent *event)
{
    if (!recordingsOf(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
}

void ReplayWindow::dropEvent(QDropEvent *event)
{
    for (const QString &path : recordingsOf(*event->mimeData()))
        emit openRequested(path);
}

} // namespace dynascope
