// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "app/dxl/device.h"
#include "core/session/backup/backup.h"

namespace dynascope::dxl {

/// All registers of a device that has said what it is.
Result<Backup> backupDevice(const Work &work, Device &device);

/// The devices' own backups: made, or put back.
ExitCode inServoCommand(const Work &work, bool restore);

} // namespace dynascope::dxl
