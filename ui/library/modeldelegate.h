// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

namespace dynascope {

/// Names of models in a list that may be narrow: one too long for its place leaves out what its neighbours have, too.
class ModelDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    static constexpr int ShortRole = Qt::UserRole + 101; ///< QString: the name without that; missing where nothing is

    using QStyledItemDelegate::QStyledItemDelegate;

protected:
    void initStyleOption(QStyleOptionViewItem *option, const QModelIndex &index) const override;
};

/// "… 4 device 5" of "HX5 sync table 4 device 5" among its like: what names that begin with the same two words all begin
/// with is left out. By name; empty where a name stays whole.
QStringList shortNames(const QStringList &names);

} // namespace dynascope
