// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/settings/settingsplan.h"

namespace dynascope {

/// Reads the spans of several devices, in as few exchanges as what is known of them (Bus::setTraits) allows: Fast Sync
/// Read, Sync Read, Bulk Read, else one after the other. For each in their order what was read; a span that the device
/// refuses is left out. An entry's error is that of its device, which is not asked again; the error of the whole one that
/// ends all: STOP, cancelled, the port gone. Devices stand together by their baud rate.
Result<std::vector<Result<RegisterImage>>> readImages(JobContext &context, const std::vector<ReadSpansPlan> &devices);

} // namespace dynascope
