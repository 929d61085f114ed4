// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journalnote.h"
#include "core/session/procedures/movedevices.h"
#include "core/session/procedures/movefile.h"

/// What the window and the command line share of moves of many devices.
namespace dynascope {

class Catalog;
class LineSession;

/// Where the plan of this line is kept, as it was named by a person. Nowhere for the simulated bus, which ends with
/// the program. Both programs find each other's.
MoveFile moveFileOf(const QString &line, const QString &folder);

/// Everybody known on the line, at home where they are. Their Secondary IDs as last read.
std::vector<MoveDevice> moveDevicesOf(const LineSession &line);

/// Where a register is, is for the control table to say, not for a file that may be damaged.
Result<void> takeTables(MovePlan &plan, const Catalog &catalog);

/// Begins the entry of one step. `endsTorque`: the device is under torque now, which is turned off for it.
JournalNote noteMoveStep(Journal *journal, JournalAuthor by, const MovePlan &plan, const MoveStep &step,
                         const QString &model, const QString &line, bool endsTorque = false);
/// The device where that step has brought it.
Found foundAfter(const MovePlan &plan, const MoveStep &step);

} // namespace dynascope
