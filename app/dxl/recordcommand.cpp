// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "app/dxl/pacedpolling.h"
#include "app/dxl/recorddevices.h"
#include "core/record/jsonsample.h"
#include "core/record/recorder.h"
#include "core/record/udpsender_posix.h"

#include <QDateTime>

#include <set>

namespace dynascope::dxl {
namespace {

/// Says when a device falls silent, and when it is back; not each time.
void noteSilence(const Work &work, std::set<quint32> &silent, const Batch &batch)
{
    for (const PollValue &value : batch.values) {
        if (value.data.empty() && silent.insert(value.device).second)
            work.output.note(value.error.text);
        else if (!value.data.empty() && silent.erase(value.device) > 0)
            work.output.note(QStringLiteral("device %1 answers again").arg(value.device));
    }
}

void send(posix::UdpSender &sender, const Batch &batch, const RecordingHeader &header)
{
    RecordedBatch recorded;
    recorded.begin = batch.begin;
    for (const PollValue &value : batch.values)
        recorded.replies.push_back({value.device, value.address, value.length, value.data, value.at});
    for (const QByteArray &datagram : jsonSamples(recorded, header, posix::UdpSender::LargestDatagram))
        sender.send(datagram);
}

/// Until the time is over, somebody interrupts, or the disk fails.
Result<void> poll(const Work &work, const RecordPlan &plan, Recorder &recorder, std::optional<posix::UdpSender> &sender)
{
    std::set<quint32> silent;
    return pollPaced(
        work.bus, plan.poll, Pace(work.options.record.rate, work.options.seconds, work.bus.line().now()),
        [&] { return !interrupted() && recorder.isRunning(); },
        [&](const Batch &batch) {
            recorder.add(batch);
            noteSilence(work, silent, batch);
            if (sender)
                send(*sender, batch, plan.header);
        });
}

void report(const Work &work, const RecorderStatus &status, LineTime length)
{
    QString text = QStringLiteral("%1 samples in %2 s, %3 kB in %4")
                       .arg(status.samples)
                       .arg(seconds(length), 0, 'f', 2)
                       .arg((status.bytes + 999) / 1000)
                       .arg(status.path);
    if (status.files > 1)
        text += QStringLiteral(" and %1 before it").arg(status.files - 1);
    if (status.missed > 0)
        text += QStringLiteral("; %1 replies did not come").arg(status.missed);
    if (status.lost > 0)
        text += QStringLiteral("; %1 samples were LOST: the disk did not keep up").arg(status.lost);
    Document document;
    document.add("file", status.path)
        .add("files", qint64(status.files))
        .add("bytes", qint64(status.bytes))
        .add("seconds", seconds(length))
        .add("samples", qint64(status.samples))
        .add("missed", qint64(status.missed))
        .add("lost", qint64(status.lost));
    work.output.result(text, document);
}

} // namespace

ExitCode recordCommand(const Work &work)
{
    std::optional<posix::UdpSender> sender;
    if (const QString &place = work.options.record.udp; !place.isEmpty()) {
        auto opened = posix::UdpSender::open(place);
        if (!opened)
            return work.output.refuse(opened.error());
        sender.emplace(std::move(*opened));
    }
    const auto plan = planRecord(work);
    if (!plan)
        return plan.error();
    RecorderSettings settings;
    settings.header = plan->header;
    settings.path = work.options.record.output;
    if (settings.path.isEmpty())
        settings.path = automaticName(QStringLiteral("."), plan->header.name, QDateTime::currentDateTime());
    settings.splitBytes = static_cast<qint64>(work.options.record.splitMegabytes * 1e6);
    settings.splitAfter = fromSeconds(work.options.record.splitMinutes * 60);
    const auto recorder = Recorder::start(settings);
    if (!recorder)
        return work.output.fail(recorder.error());
    work.output.note(QStringLiteral("recording to %1").arg((*recorder)->status().path));
    const LineTime begin = work.bus.line().now();
    const auto done = poll(work, *plan, **recorder, sender);
    const LineTime length = work.bus.line().now() - begin;
    const RecorderStatus status = (*recorder)->wait();
    report(work, status, length);
    if (!status.error.text.isEmpty())
        return work.output.fail(status.error);
    if (!done && done.error().kind != ErrorKind::Cancelled)
        return work.output.fail(done.error());
    return status.lost > 0 ? ExitCode::Failed : ExitCode::Done;
}

} // namespace dynascope::dxl
