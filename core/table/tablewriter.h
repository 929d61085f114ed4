// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/field.h"

#include <QByteArray>

namespace dynascope {

/// A model as it is written into a file: what was found out about it, and no more.
struct WrittenModel {
    QString name;
    int number = -1;
    QString series;
    int resolution = 0; ///< 0: none
    QString doubt;      ///< empty: none
    std::vector<Field> fields;
};

/// A table file (FORMAT.md) with one register a line, in the order of the addresses.
QByteArray tableFileOf(const WrittenModel &model);

} // namespace dynascope
