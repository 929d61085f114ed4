// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"

#include <QStringList>

namespace dynascope {

/// Where a person's own tables are: the folder that DYNASCOPE_TABLES names, else "dynascope/controltables" among the
/// data files of this user. It need not exist.
QString userTablesFolder();

/// A file that was not taken, and why: path and line are in the text.
struct RefusedTable : Error {
    QString file; ///< without folder
};

/// What came of a folder of tables.
struct UserTables {
    QStringList added;                 ///< names of files
    std::vector<RefusedTable> refused; ///< their models are as if the files weren't there
};

/// Adds every ".json" of `folder`, each after what it extends. One bad file doesn't keep the others out. The file
/// `except` stays out, and what has the same bytes.
UserTables addUserTables(Catalog &catalog, const QString &folder, const QString &except = {});

/// The bytes of a table file, bounded before anything reads them.
Result<QByteArray> readTableFile(const QString &path);

} // namespace dynascope
