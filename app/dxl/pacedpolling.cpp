// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/pacedpolling.h"

namespace dynascope::dxl {

using namespace std::chrono_literals;

Result<void> pollPaced(Bus &bus, PollPlan plan, Pace pace, const std::function<bool()> &goesOn,
                       const std::function<void(const Batch &)> &take)
{
    Poller poller(bus);
    poller.setPlan(std::move(plan));
    Batch batch;
    while (goesOn() && !pace.isOver(bus.line().now())) {
        const LineTime now = bus.line().now();
        const LineTime idle = std::max(pace.until(now), poller.nextDue() - now);
        if (idle > 0ns) {
            if (const auto waited = bus.wait(std::min<LineTime>(idle, 20ms)); !waited)
                return waited;
            continue;
        }
        if (const auto done = poller.runCycle(batch); !done)
            return done;
        pace.taken(batch.begin);
        take(batch);
    }
    return {};
}

} // namespace dynascope::dxl
