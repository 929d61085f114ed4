// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/statsreport.h"

#include "core/session/answerfaults.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

double seconds(LineTime duration)
{
    return std::chrono::duration<double>(duration).count();
}

double milliseconds(LineTime duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

double perSecond(quint64 count, const StatsOutcome &outcome)
{
    return outcome.duration > LineTime() ? static_cast<double>(count) / seconds(outcome.duration) : 0.0;
}

DeviceQuality qualityOf(const StatsDevice &device, const StatsOutcome &outcome)
{
    const DeviceQuality *known = outcome.quality.device(device.found.id);
    DeviceQuality quality = known ? *known : DeviceQuality();
    quality.id = device.found.id;
    return quality;
}

/// Of the devices that were polled: a scan may have heard others.
DeviceQuality sumOf(const StatsDevices &all, const StatsOutcome &outcome)
{
    DeviceQuality sum;
    for (const StatsDevice &device : all.devices)
        sum += qualityOf(device, outcome);
    return sum;
}

QString markOf(const DeviceQuality &quality)
{
    switch (verdictOn(quality)) {
    case Verdict::Bad: return QStringLiteral("!! ");
    case Verdict::Poor: return QStringLiteral("! ");
    case Verdict::Good:
    case Verdict::Unknown: break;
    }
    return {};
}

constexpr std::size_t ModelColumn = 1;

QStringList headings()
{
    QStringList texts{QStringLiteral("ID"), QStringLiteral("Model"), QStringLiteral("Good"), QStringLiteral("Bad %")};
    for (const AnswerFault fault : AllAnswerFaults)
        texts << faultName(fault);
    return texts << QStringLiteral("Retries") << QStringLiteral("p50 ms") << QStringLiteral("p99 ms")
                 << QStringLiteral("Bytes/s");
}

QStringList rowOf(const QString &id, const QString &model, const DeviceQuality &quality, const DurationCounts &durations,
    const StatsOutcome &outcome)
{
    const QString none = QStringLiteral("-");
    const auto time = [&](double part) {
        return durations.count() > 0 ? QString::number(milliseconds(durations.percentile(part)), 'f', 2) : none;
    };
    QStringList texts{id, model, QString::number(quality.good),
        quality.asked() > 0 ? markOf(quality) + QString::number(100 * quality.badShare(), 'f', 2) : none};
    for (const AnswerFault fault : AllAnswerFaults)
        texts << QString::number(countOf(quality, fault));
    return texts << QString::number(quality.retries) << time(0.5) << time(0.99)
                 << QString::number(perSecond(quality.bytes, outcome), 'f', 0);
}

Document countsDocument(Document document, const DeviceQuality &quality, const DurationCounts &durations,
    const StatsOutcome &outcome)
{
    document.add("good", qint64(quality.good))
        .add("bad", qint64(quality.bad()))
        .add("bad_share", quality.badShare())
        .add("timeouts", qint64(countOf(quality, AnswerFault::Missing)))
        .add("cut_off", qint64(quality.cutOff))
        .add("crc", qint64(quality.crcErrors))
        .add("length", qint64(quality.lengthErrors))
        .add("late", qint64(quality.lateAnswers))
        .add("retries", qint64(quality.retries));
    if (durations.count() > 0) {
        document.add("p50_ms", milliseconds(durations.percentile(0.5)))
            .add("p99_ms", milliseconds(durations.percentile(0.99)));
    }
    return document.add("bytes_per_second", perSecond(quality.bytes, outcome));
}

} // namespace

QString statsText(const Options &options, const StatsDevices &all, const StatsOutcome &outcome)
{
    std::vector<std::pair<DeviceQuality, const StatsDevice *>> devices;
    for (const StatsDevice &device : all.devices)
        devices.emplace_back(qualityOf(device, outcome), &device);
    std::ranges::stable_sort(devices, std::ranges::greater(), [](const auto &one) { return badness(one.first); });
    std::vector<QStringList> rows{headings()};
    for (const auto &[quality, device] : devices)
        rows.push_back(rowOf(QString::number(quality.id), device->model, quality, quality.responses, outcome));
    const DeviceQuality sum = sumOf(all, outcome);
    rows.push_back(rowOf(QStringLiteral("line"), {}, sum, outcome.quality.roundTrips, outcome));

    QString text = QStringLiteral("%1 at %2 bps, %3 s: %4 cycles, %5 a second, p50 %6 ms, p99 %7 ms\n%8")
                       .arg(options.port)
                       .arg(options.baudRate)
                       .arg(seconds(outcome.duration), 0, 'f', 1)
                       .arg(outcome.cycles)
                       .arg(perSecond(outcome.cycles, outcome), 0, 'f', 1)
                       .arg(milliseconds(outcome.cycleTimes.percentile(0.5)), 0, 'f', 2)
                       .arg(milliseconds(outcome.cycleTimes.percentile(0.99)), 0, 'f', 2)
                       .arg(aligned(rows, {ModelColumn}));
    for (const AnswerFault fault : AllAnswerFaults) {
        if (countOf(sum, fault) > 0)
            text += QStringLiteral("\n%1: %2 %3").arg(faultName(fault), faultMeaning(fault), usualCauses(fault));
    }
    return text;
}

Document statsDocument(const Options &options, const StatsDevices &all, const StatsOutcome &outcome)
{
    std::vector<Document> devices;
    for (const StatsDevice &device : all.devices) {
        const DeviceQuality quality = qualityOf(device, outcome);
        Document document;
        document.add("id", qint64(device.found.id));
        if (device.found.modelNumber != 0) {
            document.add("model", device.model)
                .add("model_number", qint64(device.found.modelNumber))
                .add("firmware", qint64(device.found.firmware));
        }
        document = countsDocument(document.add("watched", device.watched), quality, quality.responses, outcome);
        if (quality.bad() > 0)
            document.add("first_error", device.error.text);
        devices.push_back(document);
    }
    const BusStatistics &totals = outcome.quality.totals;
    const Document line =
        countsDocument(Document(), sumOf(all, outcome), outcome.quality.roundTrips, outcome)
            .add("exchanges", qint64(totals.exchanges))
            .add("strays", qint64(totals.strays))
            .add("bytes_sent", qint64(totals.bytesSent))
            .add("bytes_received", qint64(totals.bytesReceived))
            .add("load", outcome.duration > LineTime() ? seconds(totals.busy) / seconds(outcome.duration) : 0.0);
    Document document;
    document.add("port", options.port)
        .add("baud", qint64(options.baudRate))
        .add("seconds", seconds(outcome.duration))
        .add("cycles", qint64(outcome.cycles))
        .add("cycles_per_second", perSecond(outcome.cycles, outcome))
        .add("cycle_p50_ms", milliseconds(outcome.cycleTimes.percentile(0.5)))
        .add("cycle_p99_ms", milliseconds(outcome.cycleTimes.percentile(0.99)))
        .add("line", line)
        .add("devices", devices);
    return document;
}

} // namespace dynascope::dxl
