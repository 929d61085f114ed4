// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

#include <QStringList>

namespace dynascope {

/// What differs between the tables that one model has for its kinds of firmware, in words.

QString firmwareText(int from, int to); ///< "firmware 46 to 52", "firmware 53 and newer", "any firmware"

/// What is otherwise with this register of `own` in the model's other tables, a sentence for each range of firmware.
/// `all`: every table of the model, the oldest first. Empty: the same in all.
QStringList firmwareChanges(const Field &field, const ControlTable &own, const std::vector<ControlTablePtr> &all);
/// The same in a word or two: "since 45", "until 52", "differs".
QString firmwareMark(const Field &field, const ControlTable &own, const std::vector<ControlTablePtr> &all);
/// What `own` lacks: "Backup Ready (147): firmware 45 and newer", "Indirect Data 21 to 28 (244): ...".
QStringList onlyInOtherFirmware(const ControlTable &own, const std::vector<ControlTablePtr> &all);

} // namespace dynascope
