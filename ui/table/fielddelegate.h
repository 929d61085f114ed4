// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"

#include <QStyledItemDelegate>

namespace dynascope {

/// Paints the cells of the grid and makes the editor that fits a register: a list for enums, else a line for numbers.
/// Bits have a pop-up of their own, see BitPopup. Knows roles and no model. An editor that was not touched writes
/// nothing.
class FieldDelegate : public QStyledItemDelegate
{
    Q_OBJECT

public:
    explicit FieldDelegate(QObject *parent = nullptr);

    void setUnits(const UnitPreferences &units) { m_units = units; }

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QWidget *createEditor(QWidget *parent, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    /// Only what range and unit depend on goes to an open editor, never the value: the text is the person's.
    void setEditorData(QWidget *editor, const QModelIndex &index) const override;
    void setModelData(QWidget *editor, QAbstractItemModel *model, const QModelIndex &index) const override;
    void updateEditorGeometry(QWidget *editor, const QStyleOptionViewItem &option,
                              const QModelIndex &index) const override;
    bool editorEvent(QEvent *event, QAbstractItemModel *model, const QStyleOptionViewItem &option,
                     const QModelIndex &index) override;

signals:
    void notWritten(const QString &why) const; ///< an editor was left with something that can't be

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void paintGroup(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const;
    void paintName(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const;
    void paintText(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const;

    UnitPreferences m_units;
};

} // namespace dynascope
