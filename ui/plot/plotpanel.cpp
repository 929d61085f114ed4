// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotpanel.h"

#include "ui/common/icons.h"
#include "ui/common/watchmime.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/tracelist.h"
#include "ui/plot/tracemodel.h"

#include <QBoxLayout>
#include <QDragEnterEvent>
#include <QToolButton>

namespace dynascope {

namespace {

constexpr int WideEnough = 620; ///< from here on the list stands beside the chart
constexpr int ListWidth = 264;

} // namespace

PlotPanel::PlotPanel(Session &session, const Monitor &monitor, const TimeWindow &window, QWidget *parent)
    : QFrame(parent)
    , m_monitor(monitor)
    , m_model(new TraceModel(session, monitor, this))
    , m_chart(new PlotChart(window, this))
    , m_list(new TraceList(*m_model, this))
    , m_close(new QToolButton(m_chart))
    , m_layout(new QBoxLayout(QBoxLayout::LeftToRight, this))
{
    setAcceptDrops(true);
    m_layout->setContentsMargins(0, 0, 0, 0);
    m_layout->setSpacing(0);
    m_layout->addWidget(m_chart, 1);
    m_layout->addWidget(m_list);
    m_chart->setEmptyText(tr("Live values appear here.\nTick a register in the table or drag it here."));
    m_chart->setAccessibleName(tr("Plot"));
    m_close->setIcon(icon(QStringLiteral("close")));
    m_close->setAutoRaise(true);
    m_close->setIconSize({16, 16});
    m_close->setToolTip(tr("Close this panel and its traces"));
    m_close->setAccessibleName(m_close->toolTip());
    m_close->hide();
    connect(m_close, &QToolButton::clicked, this, &PlotPanel::closeRequested);
    connect(m_list, &TraceList::removeRequested, this, &PlotPanel::onRemoveRequested);
    connect(m_list, &TraceList::currentRowChanged, m_chart, &PlotChart::setEmphasized);
    for (const auto signal : {&TraceModel::rowsInserted, &TraceModel::rowsRemoved})
        connect(m_model, signal, this, &PlotPanel::updateList);
    connect(m_model, &TraceModel::dataChanged, this,
        [this](const QModelIndex &, const QModelIndex &, const QList<int> &roles) {
            if (roles != QList<int>{TraceModel::ValueRole}) // the list's numbers; the chart has them from the history
                refreshTraces();
        });
    m_chart->installEventFilter(this);
    m_list->installEventFilter(this);
    m_list->viewport()->installEventFilter(this);
    updateList();
}

PlotPanel::~PlotPanel() = default;

void PlotPanel::setClosable(bool closable)
{
    m_close->setVisible(closable);
}

void PlotPanel::updateList()
{
    m_list->setVisible(m_model->rowCount() > 0);
    m_list->updateGeometry();
    refreshTraces();
}

void PlotPanel::refreshTraces()
{
    m_chart->setTraces(m_model->drawn(palette()));
}

std::uint64_t PlotPanel::samplesSeen() const
{
    std::uint64_t count = 0;
    for (const Watch &watch : m_model->watches()) {
        if (const History *history = m_monitor.history(watch))
            count += history->appended();
    }
    return count;
}

LineTime PlotPanel::newest() const
{
    LineTime newest{};
    for (const Watch &watch : m_model->watches()) {
        const History *history = m_monitor.history(watch);
        if (history && !history->isEmpty())
            newest = std::max(newest, history->last().at);
    }
    return newest;
}

void PlotPanel::onRemoveRequested(const QList<int> &rows)
{
    std::vector<Watch> watches;
    for (const int row : rows)
        watches.push_back(m_model->watch(row));
    emit removeRequested(watches);
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
    m_list->setMaximumHeight(isWide ? QWIDGETSIZE_MAX : std::max(88, height() * 2 / 5));
}

void PlotPanel::changeEvent(QEvent *event)
{
    QFrame::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_chart)
        refreshTraces();
}

bool PlotPanel::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == m_chart && event->type() == QEvent::Resize) {
        m_close->adjustSize();
        m_close->move(m_chart->width() - m_close->width(), 0); // in the strip above the plot
    }
    if (event->type() == QEvent::FocusIn || event->type() == QEvent::MouseButtonPress)
        emit activated();
    return QFrame::eventFilter(watched, event);
}

} // namespace dynascope
