// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"

namespace dynascope {

/// What is uncertain about the whole table of these devices (of one model), a sentence each: firmware newer than known,
/// the table's own doubt, a model that nobody knows.
QStringList tableNotes(const std::vector<Device *> &devices);

} // namespace dynascope
