// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/commands.h"
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/bus/poll_values.h"

namespace dynascope::dxl {

/// One device whose answers are counted.
struct StatsDevice {
    Found found;
    QString model;
    QStringList watched; ///< what is read, in words
    Error error;         ///< the first one, which says most: who was silent is only said to be later
    bool answersPing = false; ///< when it was asked last, and no Read
};

struct StatsDevices {
    std::vector<StatsDevice> devices;
    PollPlan plan; ///< PollSpan::device is the index in `devices`
};

/// Who is to be polled, and for what: those that --ids names, answering or not, else whoever a scan finds.
/// InvalidArgument where nobody has a field that was asked for.
Result<StatsDevices> findStatsDevices(const Work &work);

} // namespace dynascope::dxl
