// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QByteArray>
#include <QStringList>

namespace dynascope {

/// What a foreign file doesn't say, or says wrong.
struct ImportOptions {
    QString name;    ///< of the model; empty: made of the file's name
    int number = -1; ///< of the register Model Number; −1: what the file says
};

/// A control table as a file of our own.
struct ImportedTable {
    QByteArray json;   ///< readable, and accepted by Catalog::add()
    QStringList notes; ///< what was left out or is uncertain, a sentence each
};

/// A ".model" file of ROBOTIS' dynamixel_hardware_interface: the sections [type info], [unit info] and [control table],
/// rows of cells that tabs separate. It knows names, addresses, sizes and some units, but no area, access or limits.
Result<ImportedTable> importModelFile(const QByteArray &text, const QString &fileName, const ImportOptions &options);

/// A CSV with a header of: address, size, name, and any of area, access, initial, min, max, unit, scale, signed.
Result<ImportedTable> importCsv(const QByteArray &text, const QString &fileName, const ImportOptions &options);

/// Which of the two it is, by its name or its first line. Lines that begin with "#" are remarks, in both.
Result<ImportedTable> importTable(const QByteArray &text, const QString &fileName, const ImportOptions &options);

} // namespace dynascope
