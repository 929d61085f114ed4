// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/dashboard/dashboardrow.h"

#include <QStyledItemDelegate>

namespace dynascope {

/// Figures in digits of equal width with their unit dimmed, and a small bar of how far each is between its limits. What is
/// near or beyond its limit has a sign beside its bar: never colour alone.
class DashboardDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;

    static int widthOf(DashboardColumn column, const QFont &font); ///< of the widest that comes, a bar beside it

private:
    static void paintVital(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index,
                           Vital vital);
};

/// The list of alarms, in rows like those of the devices.
class AlarmDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;
};

} // namespace dynascope
