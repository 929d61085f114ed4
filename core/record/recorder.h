// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/record/recording_values.h"

#include <QObject>
#include <QThread>

#include <map>
#include <memory>

class QDateTime;

namespace dynascope {

class RecordQueue;
class RecordWriter;

struct RecorderSettings {
    QString path; ///< of the first file, .mcap or .csv; further ones are called NAME_2, NAME_3...
    RecordingHeader header;
    qint64 splitBytes = 0;   ///< a new file from this size on; 0: never
    LineTime splitAfter{};   ///< a new file after that long; 0: never
};

/// How a recording stands.
struct RecorderStatus {
    quint64 samples = 0; ///< written
    quint64 missed = 0;  ///< replies that were asked for and did not come: they stand in it as such
    quint64 lost = 0;    ///< samples that came and are not in it: the disk could not keep up, or failed
    qint64 bytes = 0;    ///< of all its files
    int files = 0;
    QString path;        ///< of the file that is being written
    Error error;         ///< why nothing is written any more; an empty text: all is well
};

/// Records what the poller brings, on a thread of its own: whoever hands it something never waits for a disk. What has
/// come is on the disk a second later. One thread, that of its owner; its end waits until all stands in the file.
class Recorder : public QObject
{
    Q_OBJECT

public:
    /// BadFile: the file can't be made, or is there already.
    static Result<std::unique_ptr<Recorder>> start(RecorderSettings settings);
    ~Recorder() override;

    void add(const Batch &batch);
    void add(const RecordedEvent &event);
    /// It came, or its attributes or what is recorded of it changed.
    void setDevice(const RecordedDevice &device);

    RecorderStatus status() const;
    bool isRunning() const; ///< neither ended nor failed

    /// Ends it without waiting; finished() follows. Nothing is taken from then on.
    void finish();
    RecorderStatus wait(); ///< ends it, until all is written

signals:
    void failed(const dynascope::Error &error); ///< the disk is full, unplugged...: what was written before stays readable
    void finished();

private:
    explicit Recorder(RecorderSettings settings);
    std::size_t samplesOf(const RecordedBatch &batch) const;

    std::map<quint32, std::vector<RecordedField>> m_fields; ///< by device
    std::shared_ptr<RecordQueue> m_queue;
    std::unique_ptr<RecordWriter> m_writer;
    std::unique_ptr<QThread> m_thread;
};

/// "arm_2026-03-01_14-05-09.mcap" in `folder`, with a number where that is there already. `name`: of robot or port.
QString automaticName(const QString &folder, const QString &name, const QDateTime &time,
                      const QString &suffix = QStringLiteral("mcap"));

} // namespace dynascope
