// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "app/dxl/statsreport.h"
#include "core/bus/messages.h"
#include "core/bus/poller.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

using namespace std::chrono_literals;

constexpr LineTime LongestWait = 20ms; ///< without a look at the signals

/// At full rate until the time is over or somebody interrupts; `outcome` holds also what came before a failure.
Result<void> pollAll(const Work &work, StatsDevices &all, StatsOutcome &outcome)
{
    Poller poller(work.bus);
    poller.setPlan(all.plan);
    const LineQuality before = work.bus.quality();
    const LineTime begin = work.bus.line().now();
    const auto length =
        std::chrono::duration_cast<LineTime>(std::chrono::duration<double>(work.options.seconds.value_or(10.0)));
    Batch batch;
    Result<void> done;
    while (done && !interrupted() && work.bus.line().now() - begin < length) {
        const LineTime idle = poller.nextDue() - work.bus.line().now();
        if (idle > 0ns) { // everybody is silent
            done = work.bus.wait(std::min({idle, LongestWait, begin + length - work.bus.line().now()}));
            continue;
        }
        done = poller.runCycle(batch);
        if (!done)
            break;
        ++outcome.cycles;
        outcome.cycleTimes.add(batch.end - batch.begin);
        for (const PollValue &value : batch.values) {
            all.devices[value.device].answersPing = value.data.empty() && value.answersPing;
            if (Error &first = all.devices[value.device].error; value.data.empty() && first.text.isEmpty())
                first = value.error;
        }
    }
    outcome.duration = work.bus.line().now() - begin;
    outcome.quality = work.bus.quality().since(before);
    return done || done.error().kind != ErrorKind::Cancelled ? done : Result<void>();
}

Error neverAnswered(const Bus &bus, const StatsDevice &device, int baudRate)
{
    const QString text = QStringLiteral("ID %1 never answered at %2 bps").arg(device.found.id).arg(baudRate);
    if (const auto others = bus.othersAlive(device.found.id); others && !others->empty())
        return messages::withOthers({device.error.kind, text}, *others);
    return {device.error.kind, text + QStringLiteral(": is it powered, and still at this ID and rate?")};
}

} // namespace

ExitCode statsCommand(const Work &work)
{
    auto all = findStatsDevices(work);
    if (!all)
        return all.error().kind == ErrorKind::InvalidArgument ? work.output.refuse(all.error())
                                                              : work.output.fail(all.error());
    if (all->devices.empty()) {
        return work.output.fail({ErrorKind::NothingReceived,
            QStringLiteral("nobody answered at %1 bps; to look at every baud rate: dxl --port %2 scan --bauds all")
                .arg(QString::number(work.options.baudRate), work.options.port)});
    }
    StatsOutcome outcome;
    const Result<void> polled = pollAll(work, *all, outcome);
    work.output.result(statsText(work.options, *all, outcome), statsDocument(work.options, *all, outcome));
    if (!polled)
        return work.output.fail(polled.error());
    ExitCode code = ExitCode::Done;
    for (const StatsDevice &device : all->devices) {
        const DeviceQuality *quality = outcome.quality.device(device.found.id);
        if (quality && quality->good == 0 && quality->bad() > 0)
            code = work.output.fail(device.answersPing ? messages::answersOnlyPing(device.found.id)
                                                       : neverAnswered(work.bus, device, work.options.baudRate));
    }
    return code;
}

} // namespace dynascope::dxl
