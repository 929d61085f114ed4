// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/monitor.h"
#include "ui/plot/plotexport.h"
#include "ui/plot/tracedata.h"

#include <QThread>
#include <QTimer>

#include <memory>

namespace dynascope {

/// Saves a stretch of time as CSV while the window goes on: millions of lines take seconds, and STOP must not wait for
/// them. Copies the samples in slices of about a millisecond, then writes them on a thread of its own. One file at a
/// time. GUI thread; its owner's end waits until what is being written stands in the file.
class CsvSave : public QObject
{
    Q_OBJECT

public:
    struct Trace {
        Watch watch;
        TraceData look; ///< its history is asked of the monitor: it may go meanwhile
        std::shared_ptr<const DerivedHistory> derived = {}; ///< where it has samples of its own
    };

    explicit CsvSave(const Monitor &monitor, QObject *parent = nullptr);
    ~CsvSave() override;

    bool isRunning() const { return m_work != nullptr; }
    QString path() const; ///< of what is running

    /// The visible ones of `traces`, in [from, end). Not while one is running.
    void start(const QString &path, const std::vector<Trace> &traces, LineTime from, LineTime end);
    void cancel(); ///< failed() follows, unless all stood in the file already

signals:
    /// One of them, from the event loop, when it is no longer running.
    void written(const QString &path);
    void failed(const dynascope::Error &error); ///< the file is as it was; Cancelled where somebody wanted that

private:
    /// What is still to be copied of a column, counted among all samples its history ever had.
    struct Part {
        Watch watch;
        std::shared_ptr<const DerivedHistory> derived;
        std::uint64_t next = 0;
        std::uint64_t end = 0;
    };
    struct Work {
        QString path;
        std::vector<CsvColumn> columns;
        std::atomic<bool> cancelled = false;
        Result<void> result;
    };

    const History *historyOf(const Part &part) const;
    void copySome();
    bool copy(Part &part, CsvColumn &column, std::size_t &room) const;
    void write();
    void finish();

    const Monitor &m_monitor;
    QTimer m_slices;
    std::vector<Part> m_parts; ///< one for each column
    std::shared_ptr<Work> m_work;
    std::unique_ptr<QThread> m_thread;
};

} // namespace dynascope
