// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotpanel.h"

#include "ui/common/icons.h"
#include "ui/common/watchmime.h"
#include "ui/plot/measuremodel.h"
#include "ui/plot/measuretable.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/tracelist.h"
#include "ui/plot/tracemodel.h"

#include <QBoxLayout>
#include <QDragEnterEvent>
#include <QMenu>
#include <QToolButton>

namespace dynascope {

namespace {

constexpr int WideEnough = 620; ///< from here on the list stands beside the chart
constexpr int ListWidth = 264;
constexpr int ListHeight = 72;  ///< two traces; more are scrolled where the chart needs the room

} // namespace

PlotPanel::PlotPanel(const Common &common, QWidget *parent)
    : QFrame(parent)
    , m_monitor(common.monitor)
    , m_events(common.events)
    , m_sharedTime(common.window)
    , m_model(new TraceModel(common.session, common.monitor, common.colors, this))
    , m_chart(new PlotChart(common.window, this))
    , m_list(new TraceList(*m_model, this))
    , m_figures(new MeasureModel(this))
    , m_table(new MeasureTable(*m_figures, this))
    , m_more(new QToolButton(m_chart))
    , m_toLive(new QToolButton(m_chart))
    , m_menu(new QMenu(this))
    , m_layout(new QBoxLayout(QBoxLayout::LeftToRight))
{
    setAcceptDrops(true);
    auto *all = new QVBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addLayout(m_layout, 1);
    all->addWidget(m_table);
    m_table->hide();
    m_layout->setSpacing(0);
    m_layout->addWidget(m_chart, 1);
    m_layout->addWidget(m_list);
    m_chart->setEmptyText(tr("Live values appear here.\nTick a register in the table or drag it here."));
    m_chart->setAccessibleName(tr("Plot"));
    makeButtons();
    connect(m_list, &TraceList::removeRequested, this, &PlotPanel::onRemoveRequested);
    connect(m_list, &TraceList::deriveRequested, this, &PlotPanel::deriveRequested);
    connect(m_list, &TraceList::currentRowChanged, m_chart, &PlotChart::setEmphasized);
    for (const auto signal : {&TraceModel::rowsInserted, &TraceModel::rowsRemoved})
        connect(m_model, signal, this, &PlotPanel::updateList);
    connect(m_model, &TraceModel::dataChanged, this,
        [this](const QModelIndex &, const QModelIndex &, const QList<int> &roles) {
            if (roles != QList<int>{TraceModel::ValueRole}) // the list's numbers; the chart has them from the history
                refreshTraces();
        });
    connect(m_figures, &MeasureModel::modelReset, this, &PlotPanel::shareHeight);
    m_chart->installEventFilter(this);
    m_list->installEventFilter(this);
    m_list->viewport()->installEventFilter(this);
    m_table->installEventFilter(this);
    updateList();
}

PlotPanel::~PlotPanel() = default;

void PlotPanel::makeButtons()
{
    m_more->setIcon(icon(QStringLiteral("more")));
    m_more->setAutoRaise(true);
    m_more->setIconSize({16, 16});
    m_more->setToolTip(tr("More for this panel: time axis of its own, cursors, close"));
    m_more->setAccessibleName(tr("Panel menu"));
    m_more->setPopupMode(QToolButton::InstantPopup);
    m_more->setMenu(m_menu);
    connect(m_menu, &QMenu::aboutToShow, this, &PlotPanel::fillMenu);
    m_toLive->setIcon(icon(QStringLiteral("play")));
    m_toLive->setText(m_monitor.isRecorded() ? tr("Follow the replay") : tr("Back to live"));
    m_toLive->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_toLive->setIconSize({16, 16});
    m_toLive->setAutoFillBackground(true);
    m_toLive->setToolTip(tr("Follow the newest values again (double click in the plot, Home)"));
    m_toLive->hide();
    connect(m_toLive, &QToolButton::clicked, this, &PlotPanel::liveRequested);
}

void PlotPanel::fillMenu()
{
    m_menu->clear();
    QAction *own = m_menu->addAction(tr("Time axis of its &own"));
    own->setCheckable(true);
    own->setChecked(m_hasOwnTime);
    connect(own, &QAction::toggled, this, [this](bool on) {
        setOwnTime(on);
        emit ownTimeChanged();
    });
    m_menu->addSeparator();
    m_list->addDerivedActions(*m_menu);
    m_menu->addSeparator();
    QAction *close = m_menu->addAction(icon(QStringLiteral("close")), tr("&Close this panel and its traces"));
    close->setEnabled(m_isClosable);
    connect(close, &QAction::triggered, this, &PlotPanel::closeRequested);
}

void PlotPanel::placeButtons()
{
    const QRect area = m_placedIn = m_chart->plotArea().toRect();
    m_more->adjustSize();
    m_more->move(area.right() + 1 - m_more->width(), std::max(0, (area.top() - m_more->height()) / 2));
    m_toLive->adjustSize();
    m_toLive->move(area.right() - 8 - m_toLive->width(), area.top() + 8);
}

void PlotPanel::setClosable(bool closable)
{
    m_isClosable = closable;
}

void PlotPanel::setLive(bool live)
{
    m_toLive->setVisible(!live);
    placeButtons();
}

void PlotPanel::setOwnTime(bool own)
{
    if (own == m_hasOwnTime)
        return;
    m_hasOwnTime = own;
    m_ownTime = m_sharedTime; // begins with what is seen
    m_chart->setWindow(own ? m_ownTime : m_sharedTime);
}

void PlotPanel::setLabelRoom(LabelColumns room)
{
    m_chart->setLabelRoom(room);
    if (m_chart->plotArea().toRect() != m_placedIn) // each live frame comes here
        placeButtons();
}

void PlotPanel::setCursors(const PlotCursors &cursors)
{
    m_chart->setCursors(cursors);
    m_isMeasured = false;
    m_table->setVisible(cursors.isOn && m_model->rowCount() > 0);
    shareHeight();
}

void PlotPanel::measure(const PlotCursors &cursors, std::size_t &budget)
{
    if (m_table->isVisible() && !m_isMeasured)
        m_isMeasured = m_figures->measure(m_chart->traces(), cursors, m_chart->view().zero, budget);
}

void PlotPanel::setNewest(LineTime newest)
{
    m_chart->setNewest(newest);
    m_isMeasured = false;
}

const MeasureModel *PlotPanel::figures() const
{
    return m_table->isHidden() ? nullptr : m_figures;
}

void PlotPanel::showFigures()
{
    if (m_table->isVisible())
        m_figures->show();
}

void PlotPanel::updateList()
{
    m_list->setVisible(m_model->rowCount() > 0);
    m_list->updateGeometry();
    if (m_model->rowCount() == 0)
        m_table->hide();
    shareHeight();
    refreshTraces();
}

void PlotPanel::refreshTraces()
{
    PlotMarks marks;
    marks.log = &m_events;
    for (const Watch &watch : m_model->needed())
        marks.devices.insert(watch.device);
    m_chart->setMarks(marks);
    m_chart->setTraces(m_model->drawn(palette()));
    m_isMeasured = false;
}

std::uint64_t PlotPanel::samplesSeen() const
{
    std::uint64_t count = 0;
    for (const Watch &watch : m_model->needed()) {
        if (const History *history = m_monitor.history(watch))
            count += history->appended();
    }
    return count;
}

LineTime PlotPanel::newest() const
{
    LineTime newest{};
    for (const Watch &watch : m_model->needed()) {
        const History *history = m_monitor.history(watch);
        if (history && !history->isEmpty())
            newest = std::max(newest, history->last().at);
    }
    return newest;
}

void PlotPanel::onRemoveRequested(const QList<int> &rows)
{
    std::vector<TraceKey> keys;
    for (const int row : rows)
        keys.push_back(m_model->key(row));
    emit removeRequested(keys);
}

void PlotPanel::dragEnterEvent(QDragEnterEvent *event)
{
    if (watchesFromMime(event->mimeData()).empty())
        return;
    event->setDropAction(Qt::CopyAction);
    event->accept();
    m_chart->setMarked(true);
}

void PlotPanel::dragLeaveEvent(QDragLeaveEvent *)
{
    m_chart->setMarked(false);
}

void PlotPanel::dropEvent(QDropEvent *event)
{
    m_chart->setMarked(false);
    const std::vector<Watch> watches = watchesFromMime(event->mimeData());
    if (watches.empty())
        return;
    event->setDropAction(Qt::CopyAction);
    event->accept();
    emit watchesDropped(watches);
}

void PlotPanel::resizeEvent(QResizeEvent *event)
{
    QFrame::resizeEvent(event);
    const bool isWide = width() >= WideEnough;
    m_layout->setDirection(isWide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_list->setMinimumWidth(isWide ? ListWidth : 0);
    m_list->setMaximumWidth(isWide ? ListWidth : QWIDGETSIZE_MAX);
    shareHeight();
}

/// The chart has the most of it, however many traces there are: what lists and tables don't show can be scrolled to.
void PlotPanel::shareHeight()
{
    const bool isWide = width() >= WideEnough;
    const int rest = height() - std::max(m_chart->minimumSizeHint().height(), height() * 45 / 100);
    m_table->setRoom(isWide ? rest : rest - ListHeight);
    const int table = m_table->isHidden() ? 0 : m_table->sizeHint().height();
    m_list->setMaximumHeight(isWide ? QWIDGETSIZE_MAX : std::max(ListHeight, std::min(rest - table, height() * 2 / 5)));
}

void PlotPanel::changeEvent(QEvent *event)
{
    QFrame::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_chart)
        refreshTraces();
}

bool PlotPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_chart && event->type() == QEvent::Resize)
        placeButtons();
    else if (watched == m_table && event->type() == QEvent::Resize)
        shareHeight(); // narrower, it may have a scroll bar
    if (event->type() == QEvent::FocusIn || event->type() == QEvent::MouseButtonPress)
        emit activated();
    return QFrame::eventFilter(watched, event);
}

} // namespace dynascope
