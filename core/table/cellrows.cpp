// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/cellrows.h"

namespace dynascope {

std::vector<CellRow> cellRows(const QByteArray &text, QChar separator, std::size_t most)
{
    std::vector<CellRow> rows;
    int number = 0;
    const QStringList lines = QString::fromUtf8(text).split(u'\n');
    for (const QString &line : lines) {
        ++number;
        if (rows.size() >= most)
            break;
        if (line.trimmed().isEmpty())
            continue;
        CellRow row{number, line.split(separator)};
        for (QString &cell : row.cells) {
            cell = cell.trimmed();
            if (cell.size() > 1 && cell.startsWith(u'"') && cell.endsWith(u'"'))
                cell = cell.sliced(1, cell.size() - 2);
        }
        rows.push_back(row);
    }
    return rows;
}

} // namespace dynascope
