// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

namespace dynascope {

/// A cell of the library's lists: text with the margins of the headings, a small icon before it, a light tint where it
/// is selected.
class LibraryDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    static constexpr int RowHeight = 26;
    static constexpr int MarkedRole = Qt::UserRole + 100; ///< bool: in the accent's colour

    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;
};

} // namespace dynascope
