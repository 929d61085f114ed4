// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recordfile_posix.h"
#include "core/record/recordingsink.h"

#include <map>

namespace dynascope {

/// A recording as comma-separated values, as PlotJuggler and pandas open it: a heading, a column of seconds since 1970
/// (unix_time_s, when the poll cycle began), one for each device and field in physical units, a row a poll cycle. A
/// cell of what was not asked for, or did not come, is empty. Events, images and the rest of the header have no place.
class CsvSink final : public RecordingSink
{
public:
    static Result<std::unique_ptr<RecordingSink>> create(const QString &path, const RecordingHeader &header);

    Result<bool> setDevice(const RecordedDevice &device) override;
    Result<void> write(const RecordedBatch &batch) override;
    Result<void> write(const RecordedEvent &) override { return {}; }
    Result<void> flush() override;
    Result<void> finish() override { return flush(); }
    qint64 bytes() const override { return m_file.size(); }

private:
    CsvSink(posix::RecordFile file, const RecordingHeader &header);
    void appendRow(LineTime begin);
    void take(const RecordedReply &reply, LineTime begin);

    posix::RecordFile m_file;
    RecordingHeader m_header;
    std::map<quint32, std::pair<const RecordedDevice *, std::size_t>> m_devices; ///< and their first column
    std::vector<QByteArray> m_cells; ///< of the row that is being filled
    QByteArray m_text;
};

} // namespace dynascope
