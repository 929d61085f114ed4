// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapwriter.h"
#include "core/record/recordingsink.h"
#include "core/record/valuelayout.h"

#include <map>
#include <set>

namespace dynascope {

/// A recording as an MCAP file: a metadata record of the whole and one for each device; a channel for each set of devices
/// that are asked for the same registers in one poll cycle, with a message for each cycle (time: when the cycle began;
/// sequence: its number); and a channel of events. So what a message costs besides its values is shared by many.
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
        std::optional<ValueLayout> layout; ///< none: no field is recorded of this
    };
    using Span = std::pair<std::uint16_t, std::uint16_t>; ///< address, length
    /// Replies to the same question; no device twice.
    struct Group {
        Span span;
        std::vector<quint32> devices;
        std::vector<const RecordedReply *> replies;
    };

    McapSink(std::unique_ptr<mcap::Writer> writer, const RecordingHeader &header);
    void gather(const RecordedBatch &batch);
    void write(const Group &group, const RecordedBatch &batch);
    std::optional<Channel> makeChannel(const Group &group);
    QString topicFor(const ValueLayout &layout);

    static constexpr std::size_t MostSets = 16; ///< of devices, for one span; beyond that each has its own channel

    std::unique_ptr<mcap::Writer> m_writer;
    RecordingHeader m_header; ///< its devices as they are now
    std::map<std::pair<Span, std::vector<quint32>>, Channel> m_channels;
    std::map<Span, std::size_t> m_sets; ///< how many channels of more than one device there are
    std::set<QString> m_topics;
    std::optional<std::uint16_t> m_events; ///< the channel of them
    std::vector<Group> m_groups; ///< of the batch that is being written; their memory is used again
    std::size_t m_groupCount = 0;
    Bytes m_message;
};

} // namespace dynascope
