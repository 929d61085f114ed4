// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/cyclelimit.h"

#include "core/bus/pollprediction.h"

namespace dynascope {

double possibleCycleRate(const PollPlan &plan, int baudRate)
{
    const PollPrediction wire = predictPoll(plan, baudRate, {});
    return wire.isKnown && wire.met >= 1 ? wire.cycleRate : 0;
}

} // namespace dynascope
