// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "app/dxl/device.h"
#include "core/session/journal/journalnote.h"

namespace dynascope::dxl {

/// What a write may change besides itself, right now: asks the device whether a goal would turn its torque on.
std::vector<const Field *> affectedBy(Device &device, const Field &field);

/// Begins an entry of the journal: a write of what `changes` says, or what else was sent.
JournalNote noteWrite(const Work &work, const Device &device, std::vector<RegisterChange> changes,
                      const std::vector<const Field *> &affected = {});
JournalNote noteEvent(const Work &work, const Device &device, JournalKind kind, const QString &what = {});
/// By its outcome.
void finish(JournalNote &note, const Result<void> &outcome);

} // namespace dynascope::dxl
