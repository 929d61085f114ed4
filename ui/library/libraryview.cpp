// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/libraryview.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/theme.h"
#include "ui/library/librarydelegate.h"
#include "ui/library/rowstext.h"
#include "ui/table/tableheader.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>

namespace dynascope {

LibraryView::LibraryView(const QString &name, const QString &accessibleName, QWidget *parent) : QTreeView(parent)
{
    setObjectName(name);
    setAccessibleName(accessibleName);
    setFrameShape(QFrame::NoFrame);
    setUniformRowHeights(true);
    setAllColumnsShowFocus(false);
    setItemDelegate(new LibraryDelegate(this)); // the view owns it
    setSelectionMode(QAbstractItemView::ExtendedSelection);
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    setHeader(new TableHeader(this)); // the view owns it
    auto *copyRows = new QAction(tr("Copy the selected rows as text"), this);
    copyRows->setShortcut(QKeySequence::Copy);
    copyRows->setShortcutContext(Qt::WidgetShortcut);
    copyRows->setAutoRepeat(false);
    connect(copyRows, &QAction::triggered, this, &LibraryView::copy);
    addAction(copyRows);
    setContextMenuPolicy(Qt::ActionsContextMenu);
}

void LibraryView::copy() const
{
    QGuiApplication::clipboard()->setText(rowsText(*this));
}

void LibraryView::drawRow(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    // The style fills what is left of the cells: in the same tint.
    QStyleOptionViewItem quiet = option;
    const QColor tint =
        blend(option.palette.color(QPalette::Active, QPalette::Base), colors(option.palette).accent, 0.16F);
    for (const QPalette::ColorGroup group : {QPalette::Active, QPalette::Inactive})
        quiet.palette.setColor(group, QPalette::Highlight, tint);
    QTreeView::drawRow(painter, quiet, index);
}

} // namespace dynascope
