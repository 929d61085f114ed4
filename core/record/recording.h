// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/mcapreader.h"
#include "core/record/valuelayout.h"

namespace dynascope {

/// A recording that is open for reading: its index is in memory, its samples are read part by part. One thread.
class Recording
{
public:
    /// BadFile: it can't be read, or is no recording of this program.
    static Result<std::unique_ptr<Recording>> open(const QString &path);
    static Result<std::unique_ptr<Recording>> open(std::unique_ptr<QIODevice> file, const QString &name);

    /// Its devices with all that was recorded of them. Where a field's unit changed on the way, the last one.
    const RecordingHeader &header() const { return m_header; }
    bool isWhole() const { return m_reader->isWhole(); } ///< it was ended, not cut off
    quint64 messages() const { return m_reader->messages(); } ///< batches, about, and events, as far as its index tells
    LineTime begin() const { return m_begin; } ///< the first reply or event; begin() = end() where there is none
    LineTime end() const { return m_end; }

    std::size_t parts() const { return m_reader->chunks().size(); } ///< in order of time
    LineTime partEnd(std::size_t part) const;

    struct Part {
        std::vector<RecordedBatch> batches;
        std::vector<RecordedEvent> events;
    };
    Result<Part> read(std::size_t part); ///< BadFile: damaged; the others may be whole

private:
    explicit Recording(std::unique_ptr<mcap::Reader> reader) : m_reader(std::move(reader)) { }
    bool takeHeader();
    void takeChannels();
    void takeFields(const ValueLayout::Part &part);
    void takeMessage(const mcap::Message &message, Part &part) const;
    LineTime lineTime(std::uint64_t unixNs) const;

    std::unique_ptr<mcap::Reader> m_reader;
    RecordingHeader m_header;
    std::map<std::uint16_t, std::optional<ValueLayout>> m_channels; ///< without a layout: of events
    LineTime m_begin{}, m_end{};
};

/// Hands out a recording batch by batch, as a line would have brought it.
class ReplaySource
{
public:
    explicit ReplaySource(Recording &recording) : m_recording(recording) { }

    void seek(LineTime at);             ///< the next batch is the first that begins at `at` or later
    std::optional<RecordedBatch> next(); ///< nothing at the end
    /// What happened up to the batch that came last, since this was last asked.
    std::vector<RecordedEvent> takeEvents();
    std::size_t damagedParts() const { return m_damaged; } ///< that were passed over

private:
    Recording &m_recording;
    std::size_t m_nextPart = 0;
    Recording::Part m_part;
    std::size_t m_nextBatch = 0;
    std::vector<RecordedEvent> m_events;
    std::size_t m_damaged = 0;
};

/// The same as the poller would have handed it in: a value for each run of registers that was recorded.
Batch batchOf(const RecordedBatch &recorded, const RecordingHeader &header);

} // namespace dynascope
