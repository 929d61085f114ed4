// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QMap>
#include <QString>
#include <QStringList>

#include <vector>

/// The facts that tables are held against: tests/data/tables/*.csv, taken from the manufacturer's manuals by other means
/// than the tables of the program.
namespace dynascope::test {

/// A line of a file, by the names of its columns.
using FactRow = QMap<QString, QString>;

/// Ends the test where there is no such file. `name` without ".csv".
std::vector<FactRow> factRows(const QString &name);

/// The registers of a table file, one row each: "Port 1..3" at "56..58" are three.
std::vector<FactRow> registerRows(const QString &name);

/// A register in the words of the facts.
FactRow factsOf(const Field &field);

} // namespace dynascope::test
