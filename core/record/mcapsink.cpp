// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/mcapsink.h"

#include "core/record/mcapmetadata.h"

#include <algorithm>

namespace dynascope {

using namespace mcap;

Result<std::unique_ptr<RecordingSink>> McapSink::create(const QString &path, const RecordingHeader &header)
{
    auto writer = Writer::create(path, header.program);
    if (!writer)
        return tl::unexpected(writer.error());
    std::unique_ptr<McapSink> sink(new McapSink(std::move(*writer), header));
    // At once: a recording of which nothing else is left says when, where and of whom.
    if (const auto flushed = sink->flush(); !flushed)
        return tl::unexpected(flushed.error());
    return Result<std::unique_ptr<RecordingSink>>(std::move(sink));
}

McapSink::McapSink(std::unique_ptr<Writer> writer, const RecordingHeader &header)
    : m_writer(std::move(writer))
    , m_header(header)
{
    m_writer->addMetadata(QString::fromUtf16(RecordingName), textsOf(header));
    for (const RecordedDevice &device : header.devices)
        m_writer->addMetadata(QString::fromUtf16(DeviceName), textsOf(device));
}

Result<bool> McapSink::setDevice(const RecordedDevice &device)
{
    m_writer->addMetadata(QString::fromUtf16(DeviceName), textsOf(device));
    const auto known = std::find_if(m_header.devices.begin(), m_header.devices.end(),
                                    [&](const RecordedDevice &one) { return one.key == device.key; });
    const bool isSame = known != m_header.devices.end() && known->fields == device.fields && known->label == device.label;
    if (known == m_header.devices.end())
        m_header.devices.push_back(device);
    else
        *known = device;
    if (isSame) // its registers are known now, or it stands elsewhere: the topics stay
        return true;
    std::erase_if(m_channels, [&](const auto &entry) {
        const auto &devices = entry.first.second;
        return std::find(devices.begin(), devices.end(), device.key) != devices.end();
    });
    m_sets.clear();
    return true;
}

Result<void> McapSink::write(const RecordedBatch &batch)
{
    gather(batch);
    for (std::size_t i = 0; i < m_groupCount; ++i)
        write(m_groups[i], batch);
    return m_writer->waiting() >= Writer::ChunkSize ? flush() : Result<void>();
}

void McapSink::gather(const RecordedBatch &batch)
{
    m_groupCount = 0;
    for (const RecordedReply &reply : batch.replies) {
        const Span span{reply.address, reply.length};
        std::size_t place = 0;
        while (place < m_groupCount
               && (m_groups[place].span != span
                   || std::find(m_groups[place].devices.begin(), m_groups[place].devices.end(), reply.device)
                       != m_groups[place].devices.end()))
            ++place;
        if (place == m_groups.size())
            m_groups.emplace_back();
        Group &group = m_groups[place];
        if (place == m_groupCount) {
            ++m_groupCount;
            group.span = span;
            group.devices.clear();
            group.replies.clear();
        }
        group.devices.push_back(reply.device);
        group.replies.push_back(&reply);
    }
}

void McapSink::write(const Group &group, const RecordedBatch &batch)
{
    const std::pair key(group.span, group.devices);
    auto channel = m_channels.find(key);
    if (channel == m_channels.end()) {
        const auto made = makeChannel(group);
        if (!made) { // too many sets, or not all of its devices are recorded
            for (std::size_t i = 0; i < group.devices.size(); ++i)
                write(Group{group.span, {group.devices[i]}, {group.replies[i]}}, batch);
            return;
        }
        channel = m_channels.emplace(key, *made).first;
    }
    if (!channel->second.layout)
        return;
    channel->second.layout->encode(group.replies, batch.begin, m_message);
    const qint64 at = m_header.unixTime(batch.begin);
    m_writer->addMessage(channel->second.id, batch.cycle, at, at, m_message);
}

Result<void> McapSink::write(const RecordedEvent &event)
{
    if (!m_events) {
        const std::uint16_t schema =
            m_writer->addSchema(QStringLiteral("dynascope/msg/Event"), QStringLiteral("string kind\nstring text\n"));
        m_events = m_writer->addChannel(schema, QString::fromUtf16(EventsTopic), {});
    }
    const qint64 at = m_header.unixTime(event.at);
    m_writer->addMessage(*m_events, 0, at, at, messageOf(event));
    return {};
}

/// Nothing where each device is better written for itself.
std::optional<McapSink::Channel> McapSink::makeChannel(const Group &group)
{
    std::vector<ValueLayout::Part> parts;
    std::set<QString> members;
    for (const quint32 key : group.devices) {
        const RecordedDevice *device = m_header.device(key);
        ValueLayout::Part part{key, rosName(device ? device->label : QString()), {}};
        for (const RecordedField &field : device ? device->fields : std::vector<RecordedField>()) {
            if (field.address >= group.span.first && field.end() <= group.span.first + group.span.second)
                part.fields.push_back(field);
        }
        if (!members.insert(part.member).second)
            part.member += QStringLiteral("_device_%1").arg(key);
        if (!part.fields.empty())
            parts.push_back(std::move(part));
    }
    const bool isOne = group.devices.size() == 1;
    if (parts.size() < group.devices.size() || (!isOne && m_sets[group.span] >= MostSets))
        return isOne ? std::optional(Channel()) : std::nullopt;
    m_sets[group.span] += isOne ? 0 : 1;
    Channel channel;
    channel.layout.emplace(group.span.first, group.span.second, std::move(parts));
    const QString topic = topicFor(*channel.layout);
    const QString type = QStringLiteral("dynascope/msg/Batch%1").arg(m_topics.size());
    const std::uint16_t schema = m_writer->addSchema(type, channel.layout->definition());
    channel.id = m_writer->addChannel(schema, topic, textsOf(*channel.layout));
    return channel;
}

/// "/devices", and for what is asked in exchanges of its own "/devices/present_temperature".
QString McapSink::topicFor(const ValueLayout &layout)
{
    QString topic = QStringLiteral("/devices");
    if (!m_topics.empty())
        topic += u'/' + rosName(layout.parts().front().fields.front().name);
    const QString plain = topic;
    for (int number = 2; !m_topics.insert(topic).second; ++number)
        topic = QStringLiteral("%1_%2").arg(plain).arg(number);
    return topic;
}

} // namespace dynascope
