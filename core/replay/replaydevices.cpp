// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/replay/replaydevices.h"

#include "core/record/recordedvalue.h"
#include "core/table/units.h"

#include <algorithm>
#include <limits>

namespace dynascope {
namespace {

Found foundOf(const RecordedDevice &device)
{
    Found found;
    found.id = static_cast<std::uint8_t>(std::clamp(device.id, 0, 252));
    found.baudRate = std::max(1, device.baudRate);
    found.modelNumber = static_cast<std::uint16_t>(std::clamp(device.modelNumber, 0, 0xFFFF));
    found.firmware = static_cast<std::uint8_t>(std::clamp(device.firmware, 0, 0xFF));
    return found;
}

/// Where one line had devices at several rates, or one after the other at the same place, each is a line of its own here.
/// nullptr: these are too many.
LineSession *lineFor(Session &session, const QString &recorded, const Found &found)
{
    const QString line = recorded.isEmpty() ? QStringLiteral("recorded") : recorded;
    for (int number = 1;; ++number) {
        const QString name = number == 1 ? line : QStringLiteral("%1 (%2)").arg(line).arg(number);
        const auto &lines = session.lines();
        const auto open = std::ranges::find_if(lines, [&name](const auto &one) { return one->name() == name; });
        if (open == lines.end())
            return lines.size() < ReplayDevices::MostLines ? &session.open(name, found.baudRate) : nullptr;
        if ((*open)->baudRate() == found.baudRate && !(*open)->deviceAt(found.id, found.baudRate))
            return open->get();
    }
}

void takeImage(Device &device, const RecordedDevice &recorded, LineTime at)
{
    for (const RecordedSpan &span : recorded.image) {
        PollValue value;
        value.device = device.key();
        value.address = span.address;
        value.length = static_cast<std::uint16_t>(std::min<std::size_t>(span.data.size(), 0xFFFF));
        value.data = span.data;
        value.at = at;
        device.take(value, FieldState::Stale);
    }
}

EffectiveField directionOf(const RecordedField &field)
{
    EffectiveField effective;
    effective.directionBit = field.directionBit;
    return effective;
}

} // namespace

const ReplayDevice *ReplayDevices::find(quint32 recorded) const
{
    const auto at = std::ranges::find(devices, recorded, &ReplayDevice::recorded);
    return at == devices.end() ? nullptr : &*at;
}

Result<ReplayDevices> addDevices(Session &session, const RecordingHeader &header)
{
    if (header.devices.size() > ReplayDevices::Most)
        return failure(ErrorKind::BadFile,
                       QStringLiteral("The recording tells of %1 devices; no bus has so many").arg(header.devices.size()));
    ReplayDevices all;
    for (const RecordedDevice &recorded : header.devices) {
        const Found found = foundOf(recorded);
        LineSession *line = lineFor(session, recorded.line, found);
        if (!line)
            return failure(ErrorKind::BadFile, QStringLiteral("The recording tells of more than %1 lines, or of as many "
                                                              "devices at one place").arg(ReplayDevices::MostLines));
        Device &device = line->heard(found);
        if (recorded.label != QStringLiteral("ID %1").arg(recorded.id))
            device.setNickname(recorded.label);
        takeImage(device, recorded, header.startLine);
        ReplayDevice one{recorded.key, device.key(), {}};
        const auto &fields = device.table().fields();
        for (const RecordedField &field : recorded.fields) {
            const auto at = std::ranges::find_if(fields, [&field](const Field &known) {
                return known.address == field.address && known.size == field.size;
            });
            if (at == fields.end())
                ++all.unplaced;
            else
                one.fields.push_back({field, static_cast<int>(at - fields.begin())});
        }
        std::ranges::sort(one.fields, {}, [](const ReplayField &field) { return field.recorded.address; });
        all.devices.push_back(std::move(one));
    }
    return all;
}

std::optional<std::int32_t> countedRaw(const RecordedField &field, int address, ByteView registers)
{
    const std::optional<std::int64_t> raw = recordedRaw(field, address, registers);
    if (!raw)
        return std::nullopt;
    return static_cast<std::int32_t>(field.directionBit >= 0 ? signedFromRaw(directionOf(field), *raw) : *raw);
}

Bytes countedBytes(const RecordedField &field, std::int32_t counted)
{
    const std::int64_t raw = field.directionBit >= 0 ? rawFromSigned(directionOf(field), counted) : counted;
    Bytes bytes(field.size);
    putRaw(field, field.address, raw, bytes);
    return bytes;
}

} // namespace dynascope
