// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTreeView>

namespace dynascope {

/// A list of the library: whole rows are selected, in a light tint, and copied as text.
class LibraryView : public QTreeView
{
    Q_OBJECT

public:
    LibraryView(const QString &name, const QString &accessibleName, QWidget *parent = nullptr);

    void copy() const; ///< the selected rows, to the clipboard; all where none is

protected:
    void drawRow(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
};

} // namespace dynascope
