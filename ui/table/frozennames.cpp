// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/frozennames.h"

#include "ui/common/theme.h"
#include "ui/table/cellpainter.h"

#include <QContextMenuEvent>
#include <QCoreApplication>
#include <QHeaderView>
#include <QPainter>
#include <QScrollBar>
#include <QTreeView>

#include <algorithm>

namespace dynascope {

FrozenNames::FrozenNames(QTreeView &view)
    : QWidget(&view)
    , m_view(view)
{
    setObjectName(QStringLiteral("frozenNames"));
    setFocusPolicy(Qt::NoFocus);
    setAttribute(Qt::WA_OpaquePaintEvent); // else the rows below would be painted with each update, and this again
    view.viewport()->installEventFilter(this);
    connect(view.horizontalScrollBar(), &QScrollBar::valueChanged, this, &FrozenNames::place);
    connect(view.horizontalScrollBar(), &QScrollBar::rangeChanged, this, &FrozenNames::place);
    connect(view.verticalScrollBar(), &QScrollBar::valueChanged, this, qOverload<>(&QWidget::update));
    connect(view.header(), &QHeaderView::sectionResized, this, &FrozenNames::place);
    hide();
}

void FrozenNames::place()
{
    const QWidget *rows = m_view.viewport();
    // Half of the room stays for the values, however narrow the table is.
    const int width = std::min(m_view.columnWidth(0), rows->width() / 2);
    setGeometry(rows->x(), rows->y() - headerHeight(), width, rows->height() + headerHeight());
    setVisible(m_view.horizontalScrollBar()->value() > 0);
    raise();
    update();
}

bool FrozenNames::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize)
        place();
    else if (event->type() == QEvent::Paint && isVisible())
        update(); // what changed there may have a name here
    return QWidget::eventFilter(watched, event);
}

int FrozenNames::headerHeight() const
{
    return m_view.header()->height();
}

QModelIndex FrozenNames::rowAt(int y) const
{
    return m_view.indexAt({1, y - headerHeight()}).siblingAtColumn(0);
}

void FrozenNames::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    const ThemeColors &theme = colors(palette());
    painter.fillRect(rect(), palette().color(QPalette::Base));
    const QRect head(0, 0, width(), headerHeight());
    painter.fillRect(head, theme.header);
    painter.setPen(theme.dimmed);
    painter.drawText(head.adjusted(CellMargin, 0, -CellMargin, 0), Qt::AlignLeft | Qt::AlignVCenter,
                     m_view.model()->headerData(0, Qt::Horizontal).toString());
    painter.save();
    painter.setClipRect(rect().adjusted(0, headerHeight(), 0, 0));
    for (QModelIndex row = rowAt(headerHeight()); row.isValid(); row = m_view.indexBelow(row)) {
        if (m_view.visualRect(row).top() > height())
            break;
        paintRow(painter, row);
    }
    painter.restore();
    painter.setPen(theme.border);
    painter.drawLine(head.bottomLeft(), head.bottomRight());
    painter.drawLine(rect().topRight(), rect().bottomRight());
}

void FrozenNames::paintRow(QPainter &painter, const QModelIndex &name) const
{
    QRect place = m_view.visualRect(name).translated(m_view.horizontalScrollBar()->value(), headerHeight());
    const QRect whole(0, place.top(), width(), place.height());
    const bool isGroup = m_view.model()->hasChildren(name);
    place.setRight(width() - 2);
    QStyleOptionViewItem option;
    option.initFrom(&m_view);
    option.state.setFlag(QStyle::State_HasFocus, false);
    option.widget = &m_view;
    option.rect = place;
    if (isGroup) {
        painter.fillRect(whole, colors(palette()).header);
        QStyleOption branch;
        branch.initFrom(&m_view);
        branch.rect = QRect(place.left() - m_view.indentation(), place.top(), m_view.indentation(), place.height());
        branch.state = QStyle::State_Enabled | QStyle::State_Children;
        branch.state.setFlag(QStyle::State_Open, m_view.isExpanded(name));
        m_view.style()->drawPrimitive(QStyle::PE_IndicatorBranch, &branch, &painter, &m_view);
    } else if (m_view.selectionModel()->isSelected(name)) {
        painter.fillRect(whole, selectionTint(palette()));
    }
    m_view.itemDelegateForIndex(name)->paint(&painter, option, name);
}

void FrozenNames::mousePressEvent(QMouseEvent *event)
{
    const QModelIndex name = rowAt(qRound(event->position().y()));
    if (name.isValid() && m_view.model()->hasChildren(name))
        m_view.setExpanded(name, !m_view.isExpanded(name));
    else if (name.isValid())
        m_view.selectionModel()->setCurrentIndex(name, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    m_view.setFocus(Qt::MouseFocusReason);
}

void FrozenNames::mouseDoubleClickEvent(QMouseEvent *event)
{
    const QModelIndex name = rowAt(qRound(event->position().y()));
    if (name.isValid() && !m_view.model()->hasChildren(name)) // a group has opened or closed at the first click
        m_view.edit(name);
}

void FrozenNames::contextMenuEvent(QContextMenuEvent *event)
{
    emit m_view.customContextMenuRequested(event->pos() - QPoint(0, headerHeight()));
}

void FrozenNames::wheelEvent(QWheelEvent *event)
{
    QCoreApplication::sendEvent(m_view.viewport(), event);
}

} // namespace dynascope
