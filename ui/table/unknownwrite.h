// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/tableactions.h"

class QWidget;

namespace dynascope {

/// Before a register is written of which nobody knows whether it may be (Field::mayBeTried): a dialog that names
/// device, address and bytes. Returns at once; `write` is called for each device that is still there, if a person says
/// so.
void askToWriteUnknown(const std::vector<Device *> &devices, int field, std::int64_t raw,
                       const std::function<void(Device &, int field, std::int64_t raw)> &write, QWidget *parent);

} // namespace dynascope
