// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recordwriter.h"

#include <QFileInfo>

#include <algorithm>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr auto FlushAfter = 800ms; ///< of a second: the rest is for the way to here, and for the disk
constexpr auto Idle = 1h;

QString numbered(const QString &path, int number)
{
    const QFileInfo info(path);
    const QString suffix = info.suffix().isEmpty() ? QString() : u'.' + info.suffix();
    return number == 1 ? path : path.chopped(suffix.size()) + QStringLiteral("_%1").arg(number) + suffix;
}

} // namespace

RecordWriter::RecordWriter(RecorderSettings settings, std::shared_ptr<RecordQueue> queue, Failed failed)
    : m_settings(std::move(settings))
    , m_queue(std::move(queue))
    , m_failed(std::move(failed))
    , m_lastAt(m_settings.header.startLine)
{
}

Result<void> RecordWriter::open()
{
    const QString path = numbered(m_settings.path, m_status.files + 1);
    auto sink = createRecording(path, m_settings.header);
    if (!sink)
        return tl::unexpected(sink.error());
    m_sink = std::move(*sink);
    ++m_status.files;
    m_status.path = path;
    m_fileBegin.reset();
    tell();
    return {};
}

void RecordWriter::run()
{
    bool closed = false;
    while (!closed) {
        const auto items = m_queue->take(m_isDirty ? m_dirtySince + FlushAfter : Clock::now() + Idle, closed);
        if (!m_isDirty && !items.empty()) {
            m_isDirty = true;
            m_dirtySince = Clock::now();
        }
        if (m_sink) {
            if (const auto lost = noteLost(); !lost)
                fail(lost.error());
        }
        for (const RecordQueue::Item &item : items)
            take(item);
        if (m_sink && (closed || (m_isDirty && Clock::now() >= m_dirtySince + FlushAfter)))
            flush(closed);
        tell();
    }
}

void RecordWriter::take(const RecordQueue::Item &item)
{
    if (m_sink) {
        const auto written = write(item);
        if (written)
            return;
        fail(written.error());
    }
    if (const auto *batch = std::get_if<RecordedBatch>(&item)) {
        std::size_t samples = 0, missed = 0;
        count(*batch, samples, missed);
        m_queue->addLost(samples);
    }
}

void RecordWriter::flush(bool isLast)
{
    m_isDirty = false;
    const auto flushed = isLast ? m_sink->finish() : m_sink->flush();
    if (flushed)
        m_unflushed = 0;
    else
        fail(flushed.error());
}

Result<void> RecordWriter::write(const RecordQueue::Item &item)
{
    if (const auto *batch = std::get_if<RecordedBatch>(&item))
        return write(*batch);
    if (const auto *event = std::get_if<RecordedEvent>(&item))
        return m_sink->write(*event);
    return setDevice(std::get<RecordedDevice>(item));
}

Result<void> RecordWriter::write(const RecordedBatch &batch)
{
    m_lastAt = batch.begin;
    const bool tooLong =
        m_settings.splitAfter > 0ns && m_fileBegin && batch.begin - *m_fileBegin >= m_settings.splitAfter;
    const bool tooLarge = m_settings.splitBytes > 0 && m_sink->bytes() >= m_settings.splitBytes;
    if (tooLong || tooLarge) {
        if (const auto next = nextFile(); !next)
            return next;
    }
    if (!m_fileBegin)
        m_fileBegin = batch.begin;
    const qint64 before = m_sink->bytes();
    if (const auto written = m_sink->write(batch); !written)
        return written;
    std::size_t samples = 0, missed = 0;
    count(batch, samples, missed);
    m_status.samples += samples;
    m_status.missed += missed;
    m_unflushed = m_sink->bytes() == before ? m_unflushed + samples : 0;
    return {};
}

Result<void> RecordWriter::setDevice(const RecordedDevice &device)
{
    auto &devices = m_settings.header.devices;
    const auto known = std::find_if(devices.begin(), devices.end(),
                                    [&](const RecordedDevice &one) { return one.key == device.key; });
    if (known == devices.end())
        devices.push_back(device);
    else
        *known = device;
    const auto fits = m_sink->setDevice(device);
    if (!fits)
        return tl::unexpected(fits.error());
    return *fits ? Result<void>() : nextFile();
}

/// A reader shall not take for whole what is not.
Result<void> RecordWriter::noteLost()
{
    const quint64 lost = m_queue->takeLost();
    if (lost == 0)
        return {};
    return m_sink->write(RecordedEvent{m_lastAt, QStringLiteral("lost"),
                                       QStringLiteral("%1 samples are missing here: the disk did not keep up").arg(lost)});
}

Result<void> RecordWriter::nextFile()
{
    if (const auto finished = m_sink->finish(); !finished)
        return finished;
    m_unflushed = 0;
    m_finishedBytes += m_sink->bytes();
    m_sink.reset();
    return open();
}

void RecordWriter::count(const RecordedBatch &batch, std::size_t &samples, std::size_t &missed) const
{
    for (const RecordedReply &reply : batch.replies) {
        const RecordedDevice *device = m_settings.header.device(reply.device);
        const std::size_t fields = device ? fieldsIn(reply, device->fields) : 0;
        samples += reply.data.empty() ? 0 : fields;
        missed += reply.data.empty() && fields > 0 ? 1 : 0;
    }
}

void RecordWriter::fail(const Error &error)
{
    if (m_sink)
        m_finishedBytes += m_sink->bytes();
    m_sink.reset();
    m_status.error = error;
    m_status.samples -= m_unflushed;
    m_queue->addLost(m_unflushed);
    m_unflushed = 0;
    m_failed(error);
}

void RecordWriter::tell()
{
    m_status.bytes = m_finishedBytes + (m_sink ? m_sink->bytes() : 0);
    m_queue->setStatus(m_status);
}

} // namespace dynascope
