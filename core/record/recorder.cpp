// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recorder.h"

#include "core/bus/batch_values.h"
#include "core/record/recordwriter.h"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>

namespace dynascope {

Result<std::unique_ptr<Recorder>> Recorder::start(RecorderSettings settings)
{
    std::unique_ptr<Recorder> recorder(new Recorder(std::move(settings)));
    if (const auto opened = recorder->m_writer->open(); !opened)
        return tl::unexpected(opened.error());
    recorder->m_thread->start();
    return recorder;
}

Recorder::Recorder(RecorderSettings settings)
    : m_queue(std::make_shared<RecordQueue>())
{
    for (const RecordedDevice &device : settings.header.devices)
        m_fields[device.key] = device.fields;
    m_writer = std::make_unique<RecordWriter>(std::move(settings), m_queue, [this](const Error &error) {
        QMetaObject::invokeMethod(this, [this, error] { emit failed(error); }, Qt::QueuedConnection);
    });
    m_thread.reset(QThread::create([writer = m_writer.get()] { writer->run(); }));
    connect(m_thread.get(), &QThread::finished, this, &Recorder::finished);
}

Recorder::~Recorder()
{
    wait();
}

void Recorder::add(const Batch &batch)
{
    RecordedBatch recorded;
    recorded.cycle = static_cast<std::uint32_t>(batch.cycle);
    recorded.begin = batch.begin;
    recorded.replies.reserve(batch.values.size());
    for (const PollValue &value : batch.values) {
        if (m_fields.count(value.device) != 0 && !standsInAnother(batch, value))
            recorded.replies.push_back({value.device, value.address, value.length, value.data, value.at});
    }
    if (recorded.replies.empty())
        return;
    const std::size_t samples = samplesOf(recorded);
    m_queue->push(std::move(recorded), samples);
}

void Recorder::add(const RecordedEvent &event)
{
    m_queue->push(event, 0);
}

void Recorder::setDevice(const RecordedDevice &device)
{
    m_fields[device.key] = device.fields;
    m_queue->push(device, 0);
}

std::size_t Recorder::samplesOf(const RecordedBatch &batch) const
{
    std::size_t samples = 0;
    for (const RecordedReply &reply : batch.replies)
        samples += reply.data.empty() ? 0 : fieldsIn(reply, m_fields.at(reply.device));
    return samples;
}

RecorderStatus Recorder::status() const
{
    return m_queue->status();
}

bool Recorder::isRunning() const
{
    return m_thread->isRunning() && status().error.text.isEmpty();
}

void Recorder::finish()
{
    m_queue->close();
}

RecorderStatus Recorder::wait()
{
    m_queue->close();
    m_thread->wait();
    return status();
}

QString automaticName(const QString &folder, const QString &name, const QDateTime &time, const QString &suffix)
{
    QString plain;
    for (const QChar c : QFileInfo(name).fileName())
        plain += c.isLetterOrNumber() || c == u'-' ? c : QChar(u'_');
    const QString base = QStringLiteral("%1_%2").arg(plain.isEmpty() ? QStringLiteral("recording") : plain.left(80),
                                                     time.toString(QStringLiteral("yyyy-MM-dd_HH-mm-ss")));
    QString file = base;
    for (int number = 2; QFileInfo::exists(QDir(folder).filePath(file + u'.' + suffix)); ++number)
        file = QStringLiteral("%1-%2").arg(base).arg(number);
    return QDir(folder).filePath(file + u'.' + suffix);
}

} // namespace dynascope
