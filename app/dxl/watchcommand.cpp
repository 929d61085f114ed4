// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "app/dxl/pacedpolling.h"
#include "app/dxl/target.h"
#include "app/dxl/watchedfields.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

/// Says when a device falls silent, and when it is back; not each time.
void noteSilence(const Work &work, std::vector<WatchedField> &fields, const Batch &batch)
{
    for (const PollValue &value : batch.values) {
        WatchedField &field = fields[value.device];
        const bool failed = value.data.empty();
        if (failed && field.error.text.isEmpty())
            work.output.note(QStringLiteral("%1: %2").arg(field.name(), value.error.text));
        else if (!failed && !field.error.text.isEmpty())
            work.output.note(QStringLiteral("%1: it answers again").arg(field.name()));
        field.error = failed ? value.error : Error();
    }
}

/// How many samples there were, also before a failure, and from the first to the last.
struct Taken {
    quint64 samples = 0;
    LineTime first{}, last{};

    void add(LineTime at)
    {
        if (samples++ == 0)
            first = at;
        last = at;
    }
    double perSecond() const { return samples > 1 ? static_cast<double>(samples - 1) / seconds(last - first) : 0; }
};

/// One sample after the other.
Result<void> watch(const Work &work, std::vector<WatchedField> &fields, LineTime begin, Taken &taken)
{
    const auto limit = static_cast<quint64>(work.options.count.value_or(0));
    return pollPaced(
        work.bus, planOf(work.bus, fields), Pace(work.options.rate, work.options.seconds, begin),
        [&] { return !work.output.isClosed() && (limit == 0 || taken.samples < limit); },
        [&](const Batch &batch) {
            taken.add(batch.begin);
            noteSilence(work, fields, batch);
            work.output.line(sampleLine(work.options, fields, batch, seconds(batch.begin - begin)));
        });
}

void report(const Work &work, const Taken &taken)
{
    QString asked;
    if (work.options.rate > 0)
        asked = QStringLiteral(" (%1 asked for)").arg(work.options.rate);
    work.output.note(QStringLiteral("%1 samples in %2 s, %3 a second%4")
                         .arg(taken.samples)
                         .arg(seconds(taken.last - taken.first), 0, 'f', 2)
                         .arg(taken.perSecond(), 0, 'f', 1)
                         .arg(asked));
}

} // namespace

ExitCode watchCommand(const Work &work)
{
    work.output.expectLines();
    Targets targets = findTargets(work, 0);
    if (!targets.areAll())
        return targets.code;
    std::vector<WatchedField> fields;
    for (Device &device : targets.devices) {
        if (const auto added = addWatched(device, work.options, targets.devices.size() > 1, fields); !added)
            return work.output.refuse(added.error());
    }
    if (work.options.csv)
        work.output.line(csvHeading(fields));
    Taken taken;
    const auto done = watch(work, fields, work.bus.line().now(), taken);
    report(work, taken);
    if (interrupted())
        return ExitCode::Interrupted;
    if (!done)
        return work.output.fail(done.error());
    const bool silent =
        std::ranges::any_of(fields, [](const WatchedField &field) { return !field.error.text.isEmpty(); });
    return silent ? ExitCode::Failed : ExitCode::Done;
}

} // namespace dynascope::dxl
