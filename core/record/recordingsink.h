// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

#include <memory>

namespace dynascope {

/// A file that a recording is written to. One thread. Every error is a BadFile that names the file; after one, what
/// flush() brought to the disk before it stays readable.
class RecordingSink
{
public:
    virtual ~RecordingSink() = default;
    RecordingSink() = default;
    RecordingSink(const RecordingSink &) = delete;
    RecordingSink &operator=(const RecordingSink &) = delete;

    /// A device came, or what is recorded of it or its attributes changed. False: this file has no room for that, the
    /// next one does.
    virtual Result<bool> setDevice(const RecordedDevice &device) = 0;
    virtual Result<void> write(const RecordedBatch &batch) = 0;
    virtual Result<void> write(const RecordedEvent &event) = 0;
    virtual Result<void> flush() = 0;  ///< what was written outlives a pulled plug
    virtual Result<void> finish() = 0; ///< nothing is written behind it
    virtual qint64 bytes() const = 0;  ///< of the file so far
};

/// By the suffix of `path`: .csv, else MCAP.
Result<std::unique_ptr<RecordingSink>> createRecording(const QString &path, const RecordingHeader &header);

/// How many of the device's fields lie whole in what was asked for: as many samples a reply brings, if it comes.
std::size_t fieldsIn(const RecordedReply &reply, const std::vector<RecordedField> &fields);

} // namespace dynascope
