// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/rowstext.h"

#include "ui/table/tableroles.h"

#include <QTreeView>

#include <algorithm>
#include <utility>

namespace dynascope {

QString rowsText(const QTreeView &view)
{
    const QAbstractItemModel &model = *view.model();
    QModelIndexList rows = view.selectionModel()->selectedRows();
    if (rows.isEmpty()) {
        for (int row = 0; row < model.rowCount(); ++row)
            rows << model.index(row, 0);
    }
    // Of a group its registers are meant, folded or not.
    QModelIndexList single;
    for (const QModelIndex &row : rows) {
        const int below = row.data(GroupRole).isValid() ? model.rowCount(row) : 0;
        for (int child = 0; child < below; ++child) {
            if (const QModelIndex index = model.index(child, 0, row); !rows.contains(index))
                single << index;
        }
        if (below == 0)
            single << row;
    }
    rows = single;
    // In the order of the screen: parents before what is below them.
    std::ranges::sort(rows, {}, [](const QModelIndex &row) {
        const QModelIndex above = row.parent();
        return above.isValid() ? std::pair(above.row(), row.row()) : std::pair(row.row(), -1);
    });
    QStringList lines, cells;
    for (int column = 0; column < model.columnCount(); ++column) {
        if (!view.isColumnHidden(column))
            cells << model.headerData(column, Qt::Horizontal).toString();
    }
    lines << cells.join(u'\t');
    for (const QModelIndex &row : rows) {
        cells.clear();
        for (int column = 0; column < model.columnCount(); ++column) {
            if (!view.isColumnHidden(column))
                cells << row.siblingAtColumn(column).data().toString().replace(QChar(0x2212), u'-'); // for spreadsheets
        }
        lines << cells.join(u'\t');
    }
    return lines.join(u'\n') + u'\n';
}

} // namespace dynascope
