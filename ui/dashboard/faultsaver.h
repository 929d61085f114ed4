// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/faultrecords.h"
#include "ui/plot/plotexport.h"

#include <QThread>

#include <memory>

namespace dynascope {

/// The columns of a fault's file: its registers, and at last a column that is 1 at the moment of the fault.
std::vector<CsvColumn> columnsOf(const FaultRecord &record);

/// Writes what was kept around a fault as CSV, on a thread of its own. One file at a time. GUI thread; its end waits for
/// the file.
class FaultSaver : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;
    ~FaultSaver() override;

    bool isRunning() const { return m_work != nullptr; }
    void save(const QString &path, const FaultRecord &record); ///< not while one is running

signals:
    void finished(const QString &error, const QString &path); ///< `error`: why there is no file; empty: there is one

private:
    struct Work {
        QString path;
        std::vector<CsvColumn> columns;
        std::atomic<bool> cancelled = false;
        Result<void> result;
    };

    std::shared_ptr<Work> m_work;
    std::unique_ptr<QThread> m_thread;
};

} // namespace dynascope
