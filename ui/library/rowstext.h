// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QTreeView;

namespace dynascope {

/// The selected rows, all of the first level where none is: cells set apart by tabs, under their headings, with a minus
/// that spreadsheets know. Columns that are hidden are left out.
QString rowsText(const QTreeView &view);

} // namespace dynascope
