// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/controltable.h"

namespace dynascope {

/// The table's names that contain what was typed or begin like it, five at most: for who mistyped one.
QStringList namesNear(const ControlTable &table, QStringView typed);

} // namespace dynascope
