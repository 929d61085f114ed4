// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tablemenu.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
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
        if (actions.deviceCount > 1) {
            add(menu, {}, QMenu::tr("Set on All Selected…"), actions.editAll)
                ->setObjectName(QStringLiteral("editAllAction"));
            if (actions.copyToAll)
                add(menu, {},
                    QMenu::tr("Set %1 on All %2 Selected").arg(plainLabel(actions.value)).arg(actions.deviceCount),
                    actions.copyToAll)
                    ->setObjectName(QStringLiteral("copyToAllAction"));
            menu->addSeparator();
        }
    }
    add(menu, QStringLiteral("refresh"), QMenu::tr("Read again"), actions.readAgain);
    menu->popup(at);
}

} // namespace dynascope
