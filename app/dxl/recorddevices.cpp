// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/recorddevices.h"

#include "app/dxl/device.h"
#include "app/dxl/registers.h"
#include "core/record/recordedvalue.h"

#include <QDateTime>
#include <QFileInfo>

#include <algorithm>
#include <deque>

namespace dynascope::dxl {
namespace {

constexpr int GapReadThrough = 8; ///< bytes: cheaper than another request

Error noSuchField(const QString &field)
{
    return {ErrorKind::InvalidArgument, QStringLiteral("none of the devices has a field \"%1\"").arg(field)};
}

/// The fields asked for, by address. A device that was only found may lack one.
Result<std::vector<const Field *>> fieldsOf(const Device &device, const Options &options, std::vector<bool> &known)
{
    std::vector<const Field *> fields;
    for (std::size_t i = 0; i < options.registers.size(); ++i) {
        const RegisterArgument &argument = options.registers[i];
        if (argument.isByAddress()) {
            return failure(
                ErrorKind::InvalidArgument,
                QStringLiteral("%1: record takes fields by their name, whose units it knows").arg(argument.text()));
        }
        const auto field = device.field(argument.field);
        if (!field && !options.idList.empty())
            return tl::unexpected(field.error());
        known[i] = known[i] || field;
        if (field && std::ranges::find(fields, *field) == fields.end())
            fields.push_back(*field);
    }
    std::ranges::sort(fields, {}, &Field::address);
    return fields;
}

/// Reads its whole table; what it refuses is left out.
Result<std::vector<RecordedSpan>> imageOf(const Work &work, Device &device)
{
    if (device.isMute())
        return std::vector<RecordedSpan>();
    const auto readings = readFields(
        device, [](const Field &) { return true; },
        [&](double done) { work.output.progress(done, QStringLiteral("reading the control table of %1").arg(device.name())); });
    if (!readings)
        return tl::unexpected(readings.error());
    std::vector<RecordedSpan> image;
    for (const Reading &one : *readings) {
        if (!one.raw)
            continue;
        const Bytes bytes = bytesFromRaw(*one.field, *one.raw);
        if (image.empty() || image.back().address + int(image.back().data.size()) != one.field->address)
            image.push_back({one.field->address, {}});
        image.back().data.insert(image.back().data.end(), bytes.begin(), bytes.end());
    }
    return image;
}

/// Is every register between them one of the table? What is not in it may be refused.
bool isTabled(const ControlTable &table, int from, int to)
{
    while (from < to) {
        const Field *field = table.at(from);
        if (!field)
            return false;
        from = field->end();
    }
    return true;
}

void addSpans(PollPlan &plan, const Device &device, const std::vector<const Field *> &fields)
{
    const std::size_t first = plan.spans.size();
    for (const Field *field : fields) {
        if (plan.spans.size() > first) {
            Span &last = plan.spans.back().span;
            const int end = last.address + last.length;
            if (field->address - end <= GapReadThrough && isTabled(*device.table(), end, field->address)) {
                last.length = static_cast<std::uint16_t>(std::max(end, field->end()) - last.address);
                continue;
            }
        }
        plan.spans.push_back({device.id(), {device.id(), field->address, field->size}, {}});
    }
}

Traits traitsOf(Device &device)
{
    Traits traits = device.bus().traits(device.id());
    traits.fastReads = device.table()->hasFastReads(device.found().firmware);
    traits.receiveBuffer = device.table()->receiveBuffer();
    return traits;
}

Result<void> addDevice(const Work &work, Device &device, RecordPlan &plan, std::vector<bool> &known)
{
    const auto fields = fieldsOf(device, work.options, known);
    if (!fields)
        return tl::unexpected(fields.error());
    if (fields->empty())
        return {};
    auto image = imageOf(work, device);
    if (!image)
        return tl::unexpected(image.error());
    RecordedDevice recorded;
    recorded.key = device.id();
    recorded.label = QStringLiteral("ID %1").arg(device.id());
    recorded.line = work.options.port;
    recorded.id = device.id();
    recorded.baudRate = device.found().baudRate;
    recorded.model = device.model();
    recorded.modelNumber = device.found().modelNumber;
    recorded.firmware = device.found().firmware;
    recorded.image = std::move(*image);
    for (const Field *field : *fields)
        recorded.fields.push_back(recordedField(*field, device.units(*field), device.table()->resolution()));
    plan.header.devices.push_back(std::move(recorded));
    plan.poll.traits.push_back(traitsOf(device));
    addSpans(plan.poll, device, *fields);
    return {};
}

/// Those that were named, or whoever is there. Failures have been said.
tl::expected<std::deque<Device>, ExitCode> devicesFor(const Work &work)
{
    std::vector<std::uint8_t> ids = work.options.idList;
    if (ids.empty()) {
        const auto scanned = scanBaud(work.bus, {}, {});
        if (!scanned)
            return tl::unexpected(work.output.fail(scanned.error()));
        for (const Found &found : scanned->devices)
            ids.push_back(found.id);
    }
    if (ids.empty()) {
        return tl::unexpected(work.output.fail({ErrorKind::NothingReceived,
            QStringLiteral("nobody answered at %1 bps; to look at every baud rate: dxl --port %2 scan --bauds all")
                .arg(QString::number(work.options.baudRate), work.options.port)}));
    }
    std::deque<Device> devices;
    for (const std::uint8_t id : ids) {
        if (const auto known = devices.emplace_back(work.bus, id).identify(work.catalog); !known)
            return tl::unexpected(work.output.fail(withAdvice(known.error(), work.options)));
    }
    return devices;
}

} // namespace

tl::expected<RecordPlan, ExitCode> planRecord(const Work &work)
{
    auto devices = devicesFor(work);
    if (!devices)
        return tl::unexpected(devices.error());
    RecordPlan plan;
    std::vector<bool> known(work.options.registers.size(), false);
    for (Device &device : *devices) {
        if (const auto added = addDevice(work, device, plan, known); !added) {
            const bool isWish = added.error().kind == ErrorKind::InvalidArgument;
            return tl::unexpected(isWish ? work.output.refuse(added.error()) : work.output.fail(added.error()));
        }
    }
    const auto missing = std::ranges::find(known, false);
    if (missing != known.end()) {
        const auto index = static_cast<std::size_t>(missing - known.begin());
        return tl::unexpected(work.output.refuse(noSuchField(work.options.registers[index].field)));
    }
    plan.header.program = QStringLiteral("dxl ") + QLatin1String(DYNASCOPE_VERSION);
    plan.header.name =
        work.options.record.name.isEmpty() ? QFileInfo(work.options.port).fileName() : work.options.record.name;
    plan.header.notes = work.options.record.note;
    plan.header.startLine = work.bus.line().now();
    plan.header.startUnix = QDateTime::currentMSecsSinceEpoch() * 1'000'000;
    return plan;
}

} // namespace dynascope::dxl
