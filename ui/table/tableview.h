// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/tableroles.h"

#include <QTreeView>

#include <functional>
#include <map>

namespace dynascope {

/// The grid: rows of registers under groups. Enter and F2 edit, Space plots, Left and Right go along the values of a
/// row. Column widths follow what the table may hold, never the values.
class TableView : public QTreeView
{
    Q_OBJECT

public:
    explicit TableView(QWidget *parent = nullptr);

    /// Asked before an editor opens, for the value's cell: may it? Where not, the gate has done or said what there is.
    void setEditGate(std::function<bool(const QModelIndex &)> gate) { m_gate = std::move(gate); }
    /// Which cell an edit of this row means, given where the person is.
    QModelIndex editTarget(const QModelIndex &index) const;

    void startEdit(const QModelIndex &index) { edit(index, AllEditTriggers, nullptr); }

    /// Columns that a person hasn't set get room for the longest numbers of these tables.
    void makeRoomFor(const std::vector<const ControlTable *> &tables);
    void applyColumnWidths(); ///< after the model's columns have changed
    const std::map<int, int> &columnWidths() const { return m_widths; } ///< by ColumnKind
    void setColumnWidths(std::map<int, int> widths);

signals:
    void plotToggled(const QModelIndex &index);

protected:
    bool edit(const QModelIndex &index, EditTrigger trigger, QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    QModelIndex moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) override;
    void drawRow(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    void startDrag(Qt::DropActions actions) override;

private:
    void makeRoomFor(const ControlTable &table);
    void needRoom(ColumnKind kind, int width);
    std::function<bool(const QModelIndex &)> m_gate;
    std::map<int, int> m_widths;
    std::map<int, int> m_needed; ///< by ColumnKind, of this table's numbers
    bool m_applying = false;
};

} // namespace dynascope
