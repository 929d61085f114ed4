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
    if (known == m_header.devices.end())
        m_header.devices.push_back(device);
    else
        *known = device;
    std::erase_if(m_channels, [&](const auto &entry) { return std::get<0>(entry.first) == device.key; });
    return true;
}

Result<void> McapSink::write(const RecordedBatch &batch)
{
    for (const RecordedReply &reply : batch.replies) {
        const Channel &channel = channelFor(reply);
        if (!channel.layout)
            continue;
        channel.layout->encode(reply.data, m_message);
        m_writer->addMessage(channel.id, batch.cycle, m_header.unixTime(reply.at), m_header.unixTime(batch.begin),
                             m_message);
    }
    return m_writer->waiting() >= Writer::ChunkSize ? flush() : Result<void>();
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

const McapSink::Channel &McapSink::channelFor(const RecordedReply &reply)
{
    const Place place{reply.device, reply.address, reply.length};
    const auto known = m_channels.find(place);
    if (known != m_channels.end())
        return known->second;
    const RecordedDevice *device = m_header.device(reply.device);
    return m_channels[place] = device ? makeChannel(*device, reply) : Channel();
}

McapSink::Channel McapSink::makeChannel(const RecordedDevice &device, const RecordedReply &reply)
{
    std::vector<RecordedField> fields;
    for (const RecordedField &field : device.fields) {
        if (field.address >= reply.address && field.end() <= reply.address + reply.length)
            fields.push_back(field);
    }
    if (fields.empty())
        return {};
    Channel channel;
    channel.layout.emplace(reply.address, reply.length, std::move(fields));
    const QString topic = topicFor(device, *channel.layout);
    QString type = rosName(QStringView(topic).mid(1));
    type[0] = type[0].toUpper();
    const std::uint16_t schema =
        m_writer->addSchema(QStringLiteral("dynascope/msg/") + type.remove(u'_'), channel.layout->definition());
    channel.id = m_writer->addChannel(schema, topic, textsOf(device.key, *channel.layout));
    return channel;
}

/// "/ID_1", and for what comes in replies of its own "/ID_1/present_temperature".
QString McapSink::topicFor(const RecordedDevice &device, const ValueLayout &layout)
{
    QString base = QStringLiteral("/");
    for (const QChar c : device.label) {
        const bool isPlain = c.unicode() < 0x80 && (c.isLetterOrNumber() || c == u'-');
        base += isPlain ? c : QChar(u'_');
    }
    QString topic = base;
    if (topic == u"/" || m_topics.count(topic) != 0)
        topic = base + u'/' + rosName(layout.fields().front().name);
    const QString plain = topic;
    for (int number = 2; !m_topics.emplace(topic, device.key).second; ++number)
        topic = QStringLiteral("%1_%2").arg(plain).arg(number);
    return topic;
}

} // namespace dynascope
