// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

namespace dynascope {

/// What is wrong with a table file, and where: keys from the outermost in, "0" being the first of a list.
struct TableFault {
    QString text; ///< begins with model and register; empty: nothing is wrong
    QStringList path;
    QStringList elsewhere = {}; ///< the other of two that don't fit together: its place, where `path` isn't in the file

    bool isSet() const { return !text.isEmpty(); }
};

} // namespace dynascope
