// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapwriter.h"
#include "core/record/recordingsink.h"
#include "core/record/valuelayout.h"

#include <map>

namespace dynascope {

/// A recording as an MCAP file: a metadata record of the whole and one for each device, a channel for each device and
/// set of fields that come in one reply, a message a reply (log time: the reply's; publish time: when its poll cycle
/// began; sequence: that cycle's number), and a channel of events.
class McapSink final : public RecordingSink
{
public:
    static Result<std::unique_ptr<RecordingSink>> create(const QString &path, const RecordingHeader &header);

    Result<bool> setDevice(const RecordedDevice &device) override;
    Result<void> write(const RecordedBatch &batch) override;
    Result<void> write(const RecordedEvent &event) override;
    Result<void> flush() override { return m_writer->flush(); }
    Result<void> finish() override { return m_writer->finish(); }
    qint64 bytes() const override { return m_writer->bytes(); }

private:
    struct Channel {
        std::uint16_t id = 0;
        std::optional<ValueLayout> layout; ///< none: no field is recorded of this reply
    };
    using Place = std::tuple<quint32, std::uint16_t, std::uint16_t>; ///< device, address, length

    McapSink(std::unique_ptr<mcap::Writer> writer, const RecordingHeader &header);
    const Channel &channelFor(const RecordedReply &reply);
    Channel makeChannel(const RecordedDevice &device, const RecordedReply &reply);
    QString topicFor(const RecordedDevice &device, const ValueLayout &layout);

    std::unique_ptr<mcap::Writer> m_writer;
    RecordingHeader m_header; ///< its devices as they are now
    std::map<Place, Channel> m_channels;
    std::map<QString, quint32> m_topics; ///< and whose they are
    std::optional<std::uint16_t> m_events; ///< the channel of them
    Bytes m_message;
};

} // namespace dynascope
