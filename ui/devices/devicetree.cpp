// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/devicetree.h"

#include "ui/devices/devicedelegate.h"
#include "ui/devices/devicetreemodel.h"

#include <QTreeView>

namespace dynascope {

void setUpDeviceTree(QTreeView &tree, DeviceTreeModel &model)
{
    tree.setObjectName(QStringLiteral("deviceTree"));
    tree.setAccessibleName(DeviceTreeModel::tr("Devices"));
    tree.setFrameShape(QFrame::NoFrame);
    tree.setModel(&model);
    tree.setItemDelegate(new DeviceDelegate(&tree));
    tree.setHeaderHidden(true);
    tree.setIndentation(14);
    tree.setSelectionMode(QAbstractItemView::ExtendedSelection);
    tree.setEditTriggers(QAbstractItemView::NoEditTriggers);
    tree.setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    tree.setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    tree.setTextElideMode(Qt::ElideMiddle);
    QObject::connect(&model, &QAbstractItemModel::rowsInserted, &tree, [&tree](const QModelIndex &parent) {
        for (QModelIndex index = parent; index.isValid(); index = index.parent())
            tree.expand(index);
    });
    QObject::connect(&model, &QAbstractItemModel::rowsMoved, &tree,
                     [&tree](const QModelIndex &, int, int, const QModelIndex &to) { tree.expand(to); });
    tree.expandAll();
}

} // namespace dynascope
