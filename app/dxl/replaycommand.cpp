// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "app/dxl/pace.h"
#include "core/record/jsonsample.h"
#include "core/record/recordedvalue.h"
#include "core/record/recording.h"
#include "core/record/udpsender_posix.h"

#include <cmath>
#include <thread>

namespace dynascope::dxl {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

QByteArray csvHeading(const RecordingHeader &header)
{
    QString text = QStringLiteral("time_s");
    for (const RecordedDevice &device : header.devices) {
        for (const RecordedField &field : device.fields)
            text += u',' + columnTitle(device, field);
    }
    return text.toUtf8();
}

std::optional<std::int64_t> rawIn(const RecordedBatch &batch, const RecordedDevice &device, const RecordedField &field)
{
    for (const RecordedReply &reply : batch.replies) {
        if (reply.device != device.key)
            continue;
        if (const auto raw = recordedRaw(field, reply.address, reply.data))
            return raw;
    }
    return std::nullopt;
}

/// As `dxl watch` has it, with what the recording says of units.
QByteArray lineOf(const Options &options, const RecordingHeader &header, const RecordedBatch &batch)
{
    const double time = seconds(batch.begin - header.startLine);
    QByteArray text = QByteArray::number(time, 'f', 4);
    std::vector<Document> values;
    for (const RecordedDevice &device : header.devices) {
        for (const RecordedField &field : device.fields) {
            const auto raw = rawIn(batch, device, field);
            if (options.csv) {
                text += ',' + (raw ? physicalText(field, *raw) : QByteArray());
            } else if (!raw) {
                continue;
            } else if (options.json) {
                values.push_back(Document()
                                     .add("id", qint64(device.id))
                                     .add("field", field.name)
                                     .add("address", qint64(field.address))
                                     .add("raw", qint64(*raw))
                                     .add("value", physicalText(field, *raw).toDouble())
                                     .add("unit", field.unit));
            } else {
                text += QStringLiteral("  %1: %2 = ").arg(device.label, field.name).toUtf8() + physicalText(field, *raw);
                text += field.unit.isEmpty() ? QByteArray() : ' ' + field.unit.toUtf8();
            }
        }
    }
    if (!options.json)
        return text;
    return Document().add("time_s", std::round(time * 1e4) / 1e4).add("values", values).toJson().replace("\n ", "");
}

/// False: somebody interrupted.
bool waitUntil(Clock::time_point due)
{
    while (!interrupted() && Clock::now() < due)
        std::this_thread::sleep_for(std::min<Clock::duration>(due - Clock::now(), 20ms));
    return !interrupted();
}

} // namespace

ExitCode replayCommand(const Options &options, Output &output)
{
    heedSignals();
    output.expectLines();
    std::optional<posix::UdpSender> sender;
    if (!options.record.udp.isEmpty()) {
        auto opened = posix::UdpSender::open(options.record.udp);
        if (!opened)
            return output.refuse(opened.error());
        sender.emplace(std::move(*opened));
    }
    const auto recording = Recording::open(options.record.input);
    if (!recording)
        return output.fail(recording.error());
    const RecordingHeader &header = (*recording)->header();
    if (options.csv && !sender)
        output.line(csvHeading(header));
    ReplaySource source(**recording);
    if (options.record.from > 0)
        source.seek(header.startLine + fromSeconds(options.record.from));
    const Clock::time_point begin = Clock::now();
    std::optional<LineTime> first;
    int count = 0;
    while (!output.isClosed() && !interrupted() && (!options.count || count < *options.count)) {
        const auto batch = source.next();
        if (!batch)
            break;
        first = first.value_or(batch->begin);
        const double after = options.record.speed > 0 ? seconds(batch->begin - *first) / options.record.speed : 0;
        if (after > 0 && !waitUntil(begin + fromSeconds(std::min(after, 1e9))))
            break;
        for (const RecordedEvent &event : source.takeEvents())
            output.note(QStringLiteral("%1 s: %2: %3").arg(seconds(event.at - header.startLine)).arg(event.kind, event.text));
        ++count;
        if (!sender) {
            output.line(lineOf(options, header, *batch));
            continue;
        }
        for (const QByteArray &datagram : jsonSamples(*batch, header, posix::UdpSender::LargestDatagram))
            sender->send(datagram);
    }
    if (source.damagedParts() == 0)
        return ExitCode::Done;
    return output.fail({ErrorKind::BadFile, QStringLiteral("%1: %2 damaged parts of it were passed over")
                                                .arg(options.record.input)
                                                .arg(source.damagedParts())});
}

} // namespace dynascope::dxl
