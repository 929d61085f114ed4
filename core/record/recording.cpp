// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recording.h"

#include "core/record/mcapmetadata.h"

#include <QDir>
#include <QFile>

#include <algorithm>

namespace dynascope {
namespace {

constexpr qint64 LatestUnix = qint64(1) << 61; ///< ns; so that differences of two times fit

} // namespace

Result<std::unique_ptr<Recording>> Recording::open(const QString &path)
{
    const QString name = QDir::toNativeSeparators(path);
    auto file = std::make_unique<QFile>(path);
    if (!file->open(QIODevice::ReadOnly))
        return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(name, file->errorString()));
    if (file->isSequential())
        return failure(ErrorKind::BadFile, QStringLiteral("%1: this is no file").arg(name));
    return open(std::move(file), name);
}

Result<std::unique_ptr<Recording>> Recording::open(std::unique_ptr<QIODevice> file, const QString &name)
{
    auto reader = mcap::Reader::open(std::move(file), name);
    if (!reader)
        return tl::unexpected(reader.error());
    std::unique_ptr<Recording> recording(new Recording(std::move(*reader)));
    if (!recording->takeHeader())
        return failure(ErrorKind::BadFile, QStringLiteral("%1: this MCAP file is no recording of Dynascope").arg(name));
    recording->takeChannels();
    const auto &chunks = recording->m_reader->chunks();
    if (chunks.empty()) {
        recording->m_begin = recording->m_end = recording->m_header.startLine;
        return recording;
    }
    recording->m_begin = LineTime::max();
    recording->m_end = LineTime::min();
    for (const mcap::Reader::Chunk &chunk : chunks) {
        recording->m_begin = std::min(recording->m_begin, recording->lineTime(chunk.begin));
        recording->m_end = std::max(recording->m_end, recording->lineTime(chunk.end));
    }
    recording->m_end = std::max(recording->m_begin, recording->m_end);
    return recording;
}

bool Recording::takeHeader()
{
    bool found = false;
    for (const mcap::Reader::Metadata &metadata : m_reader->metadata()) {
        if (metadata.name == mcap::RecordingName && !found) {
            const auto header = mcap::headerFrom(metadata.texts);
            if (!header)
                return false;
            m_header = *header;
            found = true;
        }
        if (metadata.name != mcap::DeviceName)
            continue;
        auto device = mcap::deviceFrom(metadata.texts);
        if (!device)
            continue;
        const auto known = std::find_if(m_header.devices.begin(), m_header.devices.end(),
                                        [&](const RecordedDevice &one) { return one.key == device->key; });
        if (known == m_header.devices.end())
            m_header.devices.push_back(std::move(*device));
        else
            *known = std::move(*device);
    }
    return found;
}

void Recording::takeChannels()
{
    for (const auto &[id, channel] : m_reader->channels()) {
        if (channel.topic == mcap::EventsTopic) {
            m_channels[id] = std::nullopt;
            continue;
        }
        auto layout = mcap::layoutFrom(channel.metadata);
        if (!layout)
            continue;
        for (const ValueLayout::Part &part : layout->parts())
            takeFields(part);
        m_channels[id] = std::move(layout);
    }
    for (RecordedDevice &device : m_header.devices) {
        std::sort(device.fields.begin(), device.fields.end(),
                  [](const RecordedField &a, const RecordedField &b) { return a.address < b.address; });
    }
}

void Recording::takeFields(const ValueLayout::Part &part)
{
    auto device = std::find_if(m_header.devices.begin(), m_header.devices.end(),
                               [&](const RecordedDevice &one) { return one.key == part.device; });
    if (device == m_header.devices.end()) {
        RecordedDevice unknown;
        unknown.key = part.device;
        unknown.label = QStringLiteral("device %1").arg(unknown.key);
        device = m_header.devices.insert(device, unknown);
    }
    for (const RecordedField &field : part.fields) {
        const auto known = std::find_if(device->fields.begin(), device->fields.end(), [&](const RecordedField &one) {
            return one.address == field.address && one.size == field.size;
        });
        if (known == device->fields.end())
            device->fields.push_back(field);
        else
            *known = field;
    }
}

LineTime Recording::lineTime(std::uint64_t unixNs) const
{
    return m_header.lineTime(static_cast<qint64>(std::min<std::uint64_t>(unixNs, LatestUnix)));
}

LineTime Recording::partEnd(std::size_t part) const
{
    return lineTime(m_reader->chunks()[part].end);
}

Result<Recording::Part> Recording::read(std::size_t index)
{
    const auto messages = m_reader->read(index);
    if (!messages)
        return tl::unexpected(messages.error());
    Part part;
    for (const mcap::Message &message : *messages)
        takeMessage(message, part);
    return part;
}

void Recording::takeMessage(const mcap::Message &message, Part &part) const
{
    const auto channel = m_channels.find(message.channel);
    if (channel == m_channels.end())
        return;
    const LineTime at = lineTime(message.logTime);
    if (!channel->second) {
        if (auto event = mcap::eventFrom(message.data)) {
            event->at = at;
            part.events.push_back(std::move(*event));
        }
        return;
    }
    if (part.batches.empty() || part.batches.back().cycle != message.sequence || part.batches.back().begin != at)
        part.batches.push_back({message.sequence, at, {}});
    if (!channel->second->decode(message.data, at, part.batches.back().replies) && part.batches.back().replies.empty())
        part.batches.pop_back();
}

void ReplaySource::seek(LineTime at)
{
    m_nextPart = 0;
    while (m_nextPart < m_recording.parts() && m_recording.partEnd(m_nextPart) < at)
        ++m_nextPart;
    m_part = {};
    m_nextBatch = 0;
    m_events.clear();
    while (m_nextPart < m_recording.parts()) {
        Result<Recording::Part> part = m_recording.read(m_nextPart++);
        if (!part) {
            ++m_damaged;
            continue;
        }
        m_part = std::move(*part);
        const auto first = std::find_if(m_part.batches.begin(), m_part.batches.end(),
                                        [&](const RecordedBatch &batch) { return batch.begin >= at; });
        std::erase_if(m_part.events, [&](const RecordedEvent &event) { return event.at < at; });
        m_nextBatch = static_cast<std::size_t>(first - m_part.batches.begin());
        if (first != m_part.batches.end())
            return;
        m_events.insert(m_events.end(), m_part.events.begin(), m_part.events.end());
        m_part = {};
        m_nextBatch = 0;
    }
}

std::optional<RecordedBatch> ReplaySource::next()
{
    while (m_nextBatch >= m_part.batches.size()) {
        m_events.insert(m_events.end(), m_part.events.begin(), m_part.events.end());
        m_part = {};
        m_nextBatch = 0;
        if (m_nextPart >= m_recording.parts())
            return std::nullopt;
        Result<Recording::Part> part = m_recording.read(m_nextPart++);
        if (part)
            m_part = std::move(*part);
        else
            ++m_damaged;
    }
    RecordedBatch batch = std::move(m_part.batches[m_nextBatch++]);
    const auto later = std::find_if(m_part.events.begin(), m_part.events.end(),
                                    [&](const RecordedEvent &event) { return event.at > batch.begin; });
    m_events.insert(m_events.end(), m_part.events.begin(), later);
    m_part.events.erase(m_part.events.begin(), later);
    return batch;
}

std::vector<RecordedEvent> ReplaySource::takeEvents()
{
    return std::exchange(m_events, {});
}

Batch batchOf(const RecordedBatch &recorded, const RecordingHeader &header)
{
    Batch batch;
    batch.cycle = recorded.cycle;
    batch.begin = batch.end = recorded.begin;
    for (const RecordedReply &reply : recorded.replies) {
        batch.end = std::max(batch.end, reply.at);
        const RecordedDevice *device = header.device(reply.device);
        if (!device)
            continue;
        PollValue value;
        value.device = reply.device;
        value.at = reply.at;
        for (const RecordedField &field : device->fields) { // by address
            if (field.address < reply.address || field.end() > reply.address + reply.length)
                continue;
            if (value.length > 0 && field.address > value.address + value.length) {
                batch.values.push_back(value);
                value.length = 0;
            }
            if (value.length == 0)
                value.address = field.address;
            value.length = static_cast<std::uint16_t>(std::max(value.address + value.length, field.end()) - value.address);
            value.data.clear();
            if (!reply.data.empty()) {
                const auto at = reply.data.begin() + (value.address - reply.address);
                value.data.assign(at, at + value.length);
            }
        }
        if (value.length > 0)
            batch.values.push_back(value);
    }
    for (PollValue &value : batch.values) {
        if (value.data.empty())
            value.error = {ErrorKind::NothingReceived, QStringLiteral("it did not answer when this was recorded")};
    }
    return batch;
}

} // namespace dynascope
