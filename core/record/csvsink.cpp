// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/csvsink.h"

#include "core/record/mcapsink.h"
#include "core/record/recordedvalue.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr qsizetype WriteAt = 1 << 18; ///< bytes

QByteArray csvTitle(const QString &title)
{
    QByteArray text = title.toUtf8().replace('\n', ' ').replace('\r', ' ');
    if (text.contains(',') || text.contains('"'))
        text = '"' + text.replace('"', "\"\"") + '"';
    return text;
}

/// Seconds with all nanoseconds: a double would hold a tenth of a microsecond.
QByteArray secondsText(qint64 unixNs)
{
    constexpr qint64 PerSecond = 1'000'000'000;
    const qint64 time = std::max<qint64>(0, unixNs);
    return QByteArray::number(time / PerSecond) + '.' + QByteArray::number(time % PerSecond).rightJustified(9, '0');
}

} // namespace

Result<std::unique_ptr<RecordingSink>> CsvSink::create(const QString &path, const RecordingHeader &header)
{
    auto file = posix::RecordFile::create(path);
    if (!file)
        return tl::unexpected(file.error());
    std::unique_ptr<CsvSink> sink(new CsvSink(std::move(*file), header));
    if (const auto flushed = sink->flush(); !flushed)
        return tl::unexpected(flushed.error());
    return Result<std::unique_ptr<RecordingSink>>(std::move(sink));
}

CsvSink::CsvSink(posix::RecordFile file, const RecordingHeader &header)
    : m_file(std::move(file))
    , m_header(header)
    , m_text("unix_time_s")
{
    std::size_t column = 0;
    for (const RecordedDevice &device : m_header.devices) {
        m_devices[device.key] = {&device, column};
        column += device.fields.size();
        for (const RecordedField &field : device.fields)
            m_text += ',' + csvTitle(columnTitle(device, field));
    }
    m_text += '\n';
    m_cells.resize(column);
}

Result<bool> CsvSink::setDevice(const RecordedDevice &device)
{
    const RecordedDevice *known = m_header.device(device.key);
    return known ? known->fields == device.fields && known->label == device.label : device.fields.empty();
}

Result<void> CsvSink::write(const RecordedBatch &batch)
{
    for (const RecordedReply &reply : batch.replies)
        take(reply, batch.begin);
    if (std::any_of(m_cells.begin(), m_cells.end(), [](const QByteArray &cell) { return !cell.isNull(); }))
        appendRow(batch.begin);
    if (m_text.size() < WriteAt)
        return {};
    const auto written = m_file.append({reinterpret_cast<const std::uint8_t *>(m_text.constData()),
                                        static_cast<std::size_t>(m_text.size())});
    m_text.clear();
    return written;
}

/// A field that came twice in a cycle gets two rows.
void CsvSink::take(const RecordedReply &reply, LineTime begin)
{
    const auto known = m_devices.find(reply.device);
    if (known == m_devices.end())
        return;
    const auto &[device, firstColumn] = known->second;
    for (std::size_t i = 0; i < device->fields.size(); ++i) {
        const RecordedField &field = device->fields[i];
        if (field.address < reply.address || field.end() > reply.address + reply.length)
            continue;
        const auto raw = recordedRaw(field, reply.address, reply.data);
        QByteArray &cell = m_cells[firstColumn + i];
        if (!cell.isNull())
            appendRow(begin);
        cell = raw ? physicalText(field, *raw) : QByteArray("");
    }
}

void CsvSink::appendRow(LineTime begin)
{
    m_text += secondsText(m_header.unixTime(begin));
    for (QByteArray &cell : m_cells) {
        m_text += ',';
        m_text += cell;
        cell = QByteArray();
    }
    m_text += '\n';
}

Result<void> CsvSink::flush()
{
    const auto written = m_file.append({reinterpret_cast<const std::uint8_t *>(m_text.constData()),
                                        static_cast<std::size_t>(m_text.size())});
    m_text.clear();
    return written ? m_file.sync() : written;
}

Result<std::unique_ptr<RecordingSink>> createRecording(const QString &path, const RecordingHeader &header)
{
    return path.endsWith(QLatin1String(".csv"), Qt::CaseInsensitive) ? CsvSink::create(path, header)
                                                                     : McapSink::create(path, header);
}

std::size_t fieldsIn(const RecordedReply &reply, const std::vector<RecordedField> &fields)
{
    return static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), [&](const RecordedField &field) {
        return field.address >= reply.address && field.end() <= reply.address + reply.length;
    }));
}

} // namespace dynascope
