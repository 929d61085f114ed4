// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QStringList>

#include <vector>

namespace dynascope {

/// A line of a text file, cut into cells.
struct CellRow {
    int line = 0; ///< from 1
    QStringList cells;
};

/// The lines that aren't empty, `most` of them. Cells are trimmed, and freed of quotes around them.
std::vector<CellRow> cellRows(const QByteArray &text, QChar separator, std::size_t most);

} // namespace dynascope
