// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recorder.h"
#include "core/record/recording.h"
#include "core/record/recordingsink.h"

#include <cmath>

namespace dynascope::test {

using namespace std::chrono_literals;

constexpr std::uint16_t RecordedAddress = 126; ///< Present Current, Velocity and Position of X
constexpr std::uint16_t RecordedLength = 10;
constexpr LineTime RecordingBegin = 5s; ///< on the line's clock

inline RecordedDevice recordedDevice(quint32 key)
{
    RecordedDevice device;
    device.key = key;
    device.label = QStringLiteral("ID %1").arg(key);
    device.line = QStringLiteral("/dev/ttyUSB0");
    device.id = static_cast<int>(key);
    device.baudRate = 1'000'000;
    device.model = QStringLiteral("XM430-W350");
    device.modelNumber = 1020;
    device.firmware = 47;
    device.image = {{0, {0xFC, 0x03, 0, 0, 0, 0, 47, 1}}, {64, {1, 0, 0}}};
    device.fields = {{QStringLiteral("Present Current"), 126, 2, true, -1, QStringLiteral("mA"), 2.69, 2},
                     {QStringLiteral("Present Velocity"), 128, 4, true, -1, QStringLiteral("rev/min"), 0.229, 3},
                     {QStringLiteral("Present Position"), 132, 4, true, -1, QStringLiteral("deg"), 360.0 / 4096, 2}};
    return device;
}

inline RecordingHeader recordingHeader(quint32 devices)
{
    RecordingHeader header;
    header.startUnix = 1'790'000'000'123'456'789;
    header.startLine = RecordingBegin;
    header.program = QStringLiteral("Dynascope test");
    header.name = QStringLiteral("arm");
    header.notes = QStringLiteral("Line one\nand ünicode");
    for (quint32 key = 1; key <= devices; ++key)
        header.devices.push_back(recordedDevice(key));
    return header;
}

inline Bytes motion(quint32 device, int cycle)
{
    const double phase = cycle * 0.003 + device;
    Bytes data;
    appendLittleEndian(data, static_cast<std::uint32_t>(static_cast<int>(200 * std::sin(phase * 5)) + cycle % 3), 2);
    appendLittleEndian(data, static_cast<std::uint32_t>(static_cast<int>(90 * std::cos(phase)) - cycle % 2), 4);
    appendLittleEndian(data, static_cast<std::uint32_t>(2048 + static_cast<int>(1500 * std::sin(phase))), 4);
    return data;
}

/// One cycle a millisecond. Every 50th time the last device is silent.
inline RecordedBatch recordedBatch(quint32 devices, int cycle)
{
    RecordedBatch batch;
    batch.cycle = static_cast<std::uint32_t>(cycle);
    batch.begin = RecordingBegin + cycle * LineTime(1ms);
    for (quint32 key = 1; key <= devices; ++key) {
        const bool silent = key == devices && cycle % 50 == 49;
        batch.replies.push_back({key, RecordedAddress, RecordedLength, silent ? Bytes() : motion(key, cycle),
                                 batch.begin + key * LineTime(20us)});
    }
    return batch;
}

/// As the poller would have brought it.
inline Batch polled(const RecordedBatch &recorded)
{
    Batch batch;
    batch.cycle = recorded.cycle;
    batch.begin = recorded.begin;
    for (const RecordedReply &reply : recorded.replies) {
        PollValue value;
        value.device = reply.device;
        value.address = reply.address;
        value.length = reply.length;
        value.data = reply.data;
        value.at = reply.at;
        batch.values.push_back(value);
    }
    return batch;
}

/// So many cycles of as many devices as the header has; each event before the first cycle that is later.
inline void writeRecording(const QString &path, const RecordingHeader &header, int cycles,
                           const std::vector<RecordedEvent> &events = {})
{
    RecorderSettings settings;
    settings.path = path;
    settings.header = header;
    const auto recorder = Recorder::start(settings).value();
    auto event = events.begin();
    for (int cycle = 0; cycle < cycles; ++cycle) {
        const RecordedBatch batch = recordedBatch(static_cast<quint32>(header.devices.size()), cycle);
        for (; event != events.end() && event->at <= batch.begin; ++event)
            recorder->add(*event);
        recorder->add(polled(batch));
    }
    if (const RecorderStatus status = recorder->wait(); !status.error.text.isEmpty())
        qFatal("%s", qPrintable(status.error.text));
}

inline std::vector<RecordedBatch> allBatches(Recording &recording)
{
    ReplaySource source(recording);
    std::vector<RecordedBatch> all;
    while (auto batch = source.next())
        all.push_back(std::move(*batch));
    return all;
}

} // namespace dynascope::test
