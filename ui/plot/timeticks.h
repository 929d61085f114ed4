// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace dynascope {

/// A stretch of a time axis, in seconds; live plots have now at 0 and what was before it.
struct TimeStretch {
    double from = -10;
    double to = 0;

    double span() const { return to - from; }
};

/// The step between labels, `most` steps over the stretch at most: as clocks do, 10, 15, 30 s, then minutes and hours.
double timeStep(const TimeStretch &stretch, int most);
/// "−2.5 s", or where the stretch goes further than two minutes "−1:30 min", than an hour "−2:15 h" or "−2:15:30 h".
QString timeLabel(double seconds, double step, const TimeStretch &stretch);

} // namespace dynascope
