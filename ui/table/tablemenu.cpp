// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tablemenu.h"

#include "ui/common/icons.h"
#include "ui/table/tableroles.h"

#include <QMenu>

namespace dynascope {
namespace {

QAction *add(QMenu *menu, const QString &iconName, const QString &text, const std::function<void()> &action)
{
    QAction *entry = iconName.isEmpty() ? menu->addAction(text) : menu->addAction(icon(iconName), text);
    entry->setEnabled(action != nullptr);
    if (action)
        QObject::connect(entry, &QAction::triggered, menu, action);
    return entry;
}

} // namespace

void popupTableMenu(const QModelIndex &cell, const TableMenuActions &actions, const QPoint &at, QWidget *parent)
{
    auto *menu = new QMenu(parent);
    menu->setObjectName(QStringLiteral("tableMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    if (fieldAt(cell)) {
        const bool plotted = cell.data(WatchedRole).toInt() == Qt::Checked;
        add(menu, QStringLiteral("chart"), plotted ? QMenu::tr("Stop plotting") : QMenu::tr("Plot"), actions.togglePlot)
            ->setShortcut(Qt::Key_Space);
        menu->addSeparator();
        add(menu, QStringLiteral("edit"), QMenu::tr("Edit"), actions.edit)->setShortcut(Qt::Key_F2);
        add(menu, QStringLiteral("copy"), QMenu::tr("Copy value"), actions.copyValue)->setShortcut(QKeySequence::Copy);
        add(menu, {}, QMenu::tr("Reset to default"), actions.resetToDefault);
        if (actions.setAgain)
            add(menu, {}, QMenu::tr("Set again what the restart took"), actions.setAgain);
        menu->addSeparator();
    }
    add(menu, QStringLiteral("refresh"), QMenu::tr("Read again"), actions.readAgain);
    if (actions.applyToAll) {
        menu->addSeparator();
        QAction *all = menu->addAction(QMenu::tr("Apply edits to all %1 devices").arg(actions.deviceCount));
        all->setCheckable(true);
        all->setChecked(actions.appliesToAll);
        QObject::connect(all, &QAction::toggled, menu, actions.applyToAll);
    }
    menu->popup(at);
}

} // namespace dynascope
