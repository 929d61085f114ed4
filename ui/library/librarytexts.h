// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "core/table/units.h"

#include <QPalette>
#include <QStringList>

namespace dynascope {

/// What the library of control tables says, where no device gives values: limits by the registers' names, units by the
/// step. Rich text is made of escaped names only.

QString numberText(std::int64_t number); ///< with the minus of typography
QString sizeText(const Field &field);    ///< "2 bytes, signed"
QString boundsText(const Field &field);  ///< "−Current Limit … Current Limit"; empty: what fits the size
QString stepText(const Field &field);    ///< what one raw step is: "2.69 mA"; empty without a unit
QString addressText(int address);        ///< "102 (0x66)"

/// Resolution, modes, baud rates, abilities, names, where it comes from, doubt: rich text. `folder`: where a person's
/// own tables are.
QString modelFacts(const Catalog::ModelInfo &info, const ControlTable &table, const QString &folder,
                   const QPalette &palette);
/// Everything that is known of a register: rich text. `all`: every table of the model, the oldest firmware first.
QString registerPage(const Field &field, const ControlTable &table, const std::vector<ControlTablePtr> &all,
                     const UnitPreferences &units, const QPalette &palette);

} // namespace dynascope
