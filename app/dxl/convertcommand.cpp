// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "core/record/recording.h"
#include "core/record/recordingsink.h"

namespace dynascope::dxl {
namespace {

Result<void> copy(ReplaySource &source, RecordingSink &sink, quint64 &batches)
{
    while (const auto batch = source.next()) {
        for (const RecordedEvent &event : source.takeEvents()) {
            if (const auto written = sink.write(event); !written)
                return written;
        }
        if (const auto written = sink.write(*batch); !written)
            return written;
        ++batches;
    }
    for (const RecordedEvent &event : source.takeEvents()) {
        if (const auto written = sink.write(event); !written)
            return written;
    }
    return sink.finish();
}

} // namespace

ExitCode convertCommand(const Options &options, Output &output)
{
    const auto recording = Recording::open(options.record.input);
    if (!recording)
        return output.fail(recording.error());
    if (!(*recording)->isWhole())
        output.note(QStringLiteral("%1 was cut off; what stands whole in it is taken").arg(options.record.input));
    const auto sink = createRecording(options.record.output, (*recording)->header());
    if (!sink)
        return output.fail(sink.error());
    ReplaySource source(**recording);
    quint64 batches = 0;
    if (const auto copied = copy(source, **sink, batches); !copied)
        return output.fail(copied.error());
    output.result(QStringLiteral("%1 poll cycles in %2").arg(batches).arg(options.record.output),
                  Document().add("file", options.record.output).add("cycles", qint64(batches)));
    if (source.damagedParts() == 0)
        return ExitCode::Done;
    return output.fail({ErrorKind::BadFile, QStringLiteral("%1: %2 damaged parts of it were passed over")
                                                .arg(options.record.input)
                                                .arg(source.damagedParts())});
}

} // namespace dynascope::dxl
