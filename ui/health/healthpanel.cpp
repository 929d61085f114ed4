// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/healthpanel.h"

#include "ui/common/elidedlabel.h"
#include "ui/common/icons.h"
#include "ui/health/healthdelegate.h"
#include "ui/health/healthmodel.h"
#include "ui/table/tableheader.h"

#include <QBoxLayout>
#include <QClipboard>
#include <QGuiApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>

namespace dynascope {
namespace {

constexpr int HeaderHeight = 37;
constexpr int RoomForExplanation = 150; ///< of the whole panel's height
constexpr int ExplanationLines = 2;

QToolButton *makeButton(QWidget *parent, const char *name, const char *iconName, const QString &text)
{
    auto *button = new QToolButton(parent);
    button->setObjectName(QLatin1String(name));
    button->setIcon(icon(QLatin1String(iconName)));
    button->setIconSize(QSize(18, 18));
    button->setFixedHeight(28);
    button->setAutoRaise(true);
    button->setToolTip(text);
    button->setAccessibleName(text);
    return button;
}

QString durationText(double seconds)
{
    const auto whole = static_cast<int>(seconds);
    if (whole < 60)
        return HealthPanel::tr("counted for %1 s").arg(whole);
    if (whole < 3600)
        return HealthPanel::tr("counted for %1 min").arg(whole / 60);
    return HealthPanel::tr("counted for %1 h %2 min").arg(whole / 3600).arg(whole / 60 % 60);
}

} // namespace

HealthPanel::HealthPanel(QWidget *parent)
    : QWidget(parent)
    , m_model(new HealthModel(this))
    , m_view(new QTreeView(this))
    , m_stack(new QStackedWidget(this))
    , m_empty(new QLabel(this))
    , m_explanation(new QLabel(this))
{
    setObjectName(QStringLiteral("healthPanel"));
    setMinimumHeight(96);
    makeView();
    m_empty->setObjectName(QStringLiteral("healthEmpty"));
    m_empty->setAlignment(Qt::AlignCenter);
    m_empty->setWordWrap(true);
    m_empty->setForegroundRole(QPalette::PlaceholderText);
    m_stack->addWidget(m_empty);
    m_stack->addWidget(m_view);
    m_explanation->setObjectName(QStringLiteral("healthExplanation"));
    m_explanation->setWordWrap(true);
    m_explanation->setTextFormat(Qt::PlainText);
    m_explanation->setContentsMargins(12, 4, 12, 6);
    m_explanation->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_explanation->setFixedHeight(ExplanationLines * fontMetrics().lineSpacing() + 10); // the table doesn't jump
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(makeHeader());
    layout->addWidget(m_stack, 1);
    layout->addWidget(m_explanation);
    connect(m_model, &HealthModel::refreshed, this, &HealthPanel::refresh);
    refresh();
}

QWidget *HealthPanel::makeHeader()
{
    auto *header = new QWidget(this);
    header->setFixedHeight(HeaderHeight);
    auto *layout = new QHBoxLayout(header);
    layout->setContentsMargins(12, 4, 4, 4);
    layout->setSpacing(4);
    auto *title = new QLabel(tr("Bus health"), header);
    QFont bold = title->font();
    bold.setWeight(QFont::DemiBold);
    title->setFont(bold);
    layout->addWidget(title);
    m_since = new ElidedLabel(header);
    m_since->setObjectName(QStringLiteral("healthSince"));
    m_since->setForegroundRole(QPalette::PlaceholderText);
    layout->addSpacing(4);
    layout->addWidget(m_since, 1);
    m_anew = makeButton(header, "healthAnewButton", "refresh", tr("Forget what was counted so far"));
    m_anew->setText(tr("Start counting anew"));
    m_anew->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(m_anew, &QToolButton::clicked, this, [this] {
        if (m_model->line())
            m_model->line()->health().startAnew();
    });
    m_copy = makeButton(header, "healthCopyButton", "copy", tr("Copy the table as text"));
    connect(m_copy, &QToolButton::clicked, this, &HealthPanel::copy);
    auto *close = makeButton(header, "healthCloseButton", "close", tr("Close Bus health"));
    connect(close, &QToolButton::clicked, this, &HealthPanel::closeRequested);
    for (QToolButton *button : {m_anew, m_copy, close})
        layout->addWidget(button);
    return header;
}

void HealthPanel::makeView()
{
    m_view->setObjectName(QStringLiteral("healthView"));
    m_view->setAccessibleName(tr("Bus health"));
    m_view->setFrameShape(QFrame::NoFrame);
    m_view->setRootIsDecorated(false);
    m_view->setItemsExpandable(false);
    m_view->setUniformRowHeights(true);
    m_view->setAllColumnsShowFocus(false);
    m_view->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_view->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_view->setItemDelegate(new HealthDelegate(m_view));
    auto *heading = new TableHeader(m_view);
    m_view->setHeader(heading);
    m_view->setModel(m_model);
    heading->setStretchLastSection(false);
    heading->setSectionResizeMode(QHeaderView::Fixed);
    for (int column = 1; column < HealthColumns; ++column)
        heading->resizeSection(column, HealthDelegate::widthOf(column, font()));
    heading->setMinimumSectionSize(HealthDelegate::widthOf(static_cast<int>(HealthColumn::Id), font()));
    for (const HealthColumn column : {HealthColumn::Name, HealthColumn::Bad})
        heading->setSectionResizeMode(static_cast<int>(column), QHeaderView::Stretch);

    m_view->setMouseTracking(true);
    m_view->viewport()->installEventFilter(this);
    heading->setMouseTracking(true);
    heading->viewport()->setMouseTracking(true);
    heading->viewport()->installEventFilter(this);
    connect(m_view->selectionModel(), &QItemSelectionModel::currentChanged, this, [this] {
        m_hoveredHeading = -1; // the mouse only rests there
        m_hovered = QModelIndex();
        explain();
    });
    connect(m_view->selectionModel(), &QItemSelectionModel::selectionChanged, this, &HealthPanel::explain);

    auto *copyAction = new QAction(tr("Copy the table as text"), m_view);
    copyAction->setShortcut(QKeySequence::Copy);
    copyAction->setShortcutContext(Qt::WidgetShortcut);
    connect(copyAction, &QAction::triggered, this, &HealthPanel::copy);
    m_view->addAction(copyAction);
}

void HealthPanel::setLine(LineSession *line)
{
    m_model->setLine(line);
    refresh();
}

void HealthPanel::copy() const
{
    QGuiApplication::clipboard()->setText(m_model->toText());
}

void HealthPanel::refresh()
{
    const bool any = m_model->rowCount() > 0;
    m_stack->setCurrentIndex(any ? 1 : 0);
    m_empty->setText(m_model->line() ? tr("How well each device answers appears here, once one is found on the line.")
                                     : tr("How well the devices of a line answer appears here, once one is open."));
    m_anew->setEnabled(any);
    m_copy->setEnabled(any);
    m_since->setText(any ? durationText(m_model->line()->health().seconds()) : QString());
    explain();
}

/// What the mouse is at, else what is selected, else the worst device.
void HealthPanel::explain()
{
    const QItemSelectionModel &selection = *m_view->selectionModel();
    QString text;
    QModelIndex at = m_hovered;
    if (!at.isValid() && selection.hasSelection())
        at = selection.currentIndex();
    if (m_hoveredHeading >= 0)
        text = healthHelp(static_cast<HealthColumn>(m_hoveredHeading));
    else if (const HealthRow *row = m_model->row(at.isValid() ? at.row() : 0))
        text = healthHelp(*row, at.isValid() ? static_cast<HealthColumn>(at.column()) : HealthColumn::Bad);
    m_explanation->setText(text);
}

bool HealthPanel::eventFilter(QObject *watched, QEvent *event)
{
    const bool isHeading = watched == m_view->header()->viewport();
    if (event->type() == QEvent::MouseMove) {
        const QPoint position = static_cast<QMouseEvent *>(event)->position().toPoint();
        m_hoveredHeading = isHeading ? m_view->header()->logicalIndexAt(position) : -1;
        m_hovered = isHeading ? QModelIndex() : m_view->indexAt(position);
        explain();
    } else if (event->type() == QEvent::Leave) {
        m_hoveredHeading = -1;
        m_hovered = QModelIndex();
        explain();
    }
    return QWidget::eventFilter(watched, event);
}

void HealthPanel::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    m_explanation->setVisible(height() >= RoomForExplanation);
}

} // namespace dynascope
