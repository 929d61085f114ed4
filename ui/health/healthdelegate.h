// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

namespace dynascope {

/// Figures in digits of equal width, zeros dimmed, and the share of bad answers as a sign and a bar beside its number:
/// never by colour alone.
class HealthDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;

    static int widthOf(int column, const QFont &font); ///< of the widest that comes
    /// How much of the bar `share` fills, 0..1: 0.01 % nothing, 100 % all, each decade the same.
    static double barPart(double share);

private:
    static void paintShare(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index);
};

} // namespace dynascope
