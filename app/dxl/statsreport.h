// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/output.h"
#include "app/dxl/statsdevices.h"
#include "core/bus/quality_values.h"

namespace dynascope::dxl {

/// What polling came to.
struct StatsOutcome {
    LineTime duration{};
    quint64 cycles = 0;
    DurationCounts cycleTimes;
    LineQuality quality; ///< of the polling alone
};

/// A table, the worst device first, with the usual causes of what was seen below it.
QString statsText(const Options &options, const StatsDevices &all, const StatsOutcome &outcome);
Document statsDocument(const Options &options, const StatsDevices &all, const StatsOutcome &outcome);

} // namespace dynascope::dxl
